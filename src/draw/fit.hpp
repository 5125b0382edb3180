// One camera for a whole clip: places in metres, each with the room on the page that what is drawn there
// needs.
#pragma once

#include <vector>

#include "picture/camera.hpp"

namespace chainreel {

// Half sizes of what is drawn around a place: those on the page, or `metres` x scale + `beyond` where that is
// less.
struct Room {
  double left = 0, right = 0, down = 0, up = 0;  // units of H
  double metres = -1;                            // negative: no such bound
  double beyond = 0;                             // units of H
};

inline Room room_around(double radius) {
  return {radius, radius, radius, radius};
}

// Grows over all frames of a clip; one box per kind of thing, so that its size never depends on the clip's
// length.
class FitBox {
 public:
  int add_kind(const Room& room);
  void add(int kind,
           Point place_m);  // along the camera's right and up, m; places that are not finite are passed over

  void add(const FitBox& other);  // everything that it holds

  bool empty() const;
  // The whole in metres when one metre measures `scale`.
  Rect box(double scale) const;

 private:
  struct Kind {
    Room room;
    bool used = false;
    Rect places;
  };
  std::vector<Kind> kinds_;
};

// Scale and origin of the camera such that everything, margins included, just fills `area`.
void fit_to(Camera& camera, const FitBox& box, const Rect& area, double margin);

}  // namespace chainreel
