// What films say by themselves, beside what it concerns: the first time of each event that has a name and a place, of constraints that lose
// rank, and the limit that ended a run. The note below the scene says it, too, and alone where here is no room.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "draw/layers/layer.hpp"

namespace chainreel {

inline constexpr double kBeforeCallout = 0.1, kAfterCallout = 0.6;  // s of the film, about its instant

struct Callout {
  double at = 0;  // s of the motion
  std::string words;
  Eigen::Vector3d place;  // in W, at that instant
};

// In the order of time. Nothing of what `annotate:` of the page is about, nor of what concerns several places.
std::vector<Callout> callouts_of(const Stage& stage, const StagedRun& motion);

class Callouts {
 public:
  // Cells of a comparison have no room for them.
  explicit Callouts(const Stage& stage);

  bool empty() const { return runs_.empty(); }
  void draw(const Shot& shot) const;

 private:
  struct Shown {
    Callout callout;
    std::vector<TextLine> shapes;  // on one line, and on two where it is long
  };

  const Stage* stage_;
  std::map<const StagedRun*, std::vector<Shown>> runs_;
};

}  // namespace chainreel
