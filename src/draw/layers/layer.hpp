// What a picture is made of: layers that lie over one another. Each is one file that no other knows; the list of all,
// in painter's order, is in scene/layers.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/page/mark_labels.hpp"
#include "draw/page/panel.hpp"
#include "draw/page/sheet.hpp"

namespace chainreel {

// A motion as it stands at one of its samples, before its panel has a place.
struct Sight {
  const StagedRun& motion;
  const Workspace& ws;  // after compute_kinematics
  int k = 0;
  const Camera& camera;
  double marks = 1;  // size of marks, as in ChainLook
};

// What is drawn of a panel at one of its frames.
struct Shot {
  const Panel& panel;
  const Workspace& ws;  // after compute_kinematics
  int k = 0;
  bool is_over = false;  // the film goes on, the panel stands still
  Point corner;          // lower left of the room that the layer asked for
  MarkLabels& labels;    // takes words, which are drawn above all marks
  bool is_still = false;  // looked at by itself: nothing runs in it
};

// The page that all panels share.
struct SharedPage {
  const Sheet& sheet;
  Camera camera;  // of the first panel
  Rect scene;     // ... and what it has for a metre bar
};

enum class UnderWords { never, if_need_be, freely };

// Made whole by its constructor from what is to be shown, of which it may keep references. All members but the
// destructor do nothing unless a layer has something to say there.
class Layer {
 public:
  virtual ~Layer() = default;

  // Whether it has to do with this motion: with those that are not drawn over others in outline.
  virtual bool is_of(const StagedRun& motion) const { return !motion.is_outlined(); }

  // What it says on the page around the scene.
  virtual void write(SheetText&) const {}

  // Measure: what the camera must hold of it, beside the chain itself.
  virtual void measure(const Sight&, FitBox&) const {}
  // Wish: what it is to hold, too, as far as that costs little of the scale.
  virtual void wish(const Sight&, FitBox&) const {}
  // Width and height of a part of each scene in a corner, or beside it, that it needs for itself. One layer of a film.
  virtual std::optional<Point> room_beside(const StagedRun&) const { return std::nullopt; }
  // Height of a row below all scenes, above what is written at the page's foot, that it needs for itself.
  virtual double row_below() const { return 0; }
  virtual std::string no_room() const { return ""; }  // what to say where it leaves none to the chain
  // Lowers the share of its arrows' length to the largest one that keeps all of them within the scene.
  virtual void shorten_arrows(const Rect& /*scene*/, const Sight&, ArrowShares&) const {}
  // Covers: whether any of it comes into this part of the page, which may be at the lower left of its scene.
  virtual bool covers(const Sight&, const Rect& part, bool at_lower_left) const;

  // Whether words of marks may stand on what it draws.
  virtual UnderWords under_words() const { return UnderWords::never; }
  // Whether it adds such words.
  virtual bool has_words() const { return false; }

  // Draw once: what no frame changes.
  virtual void draw_once(Picture&, const Panel&) const {}
  virtual void draw_page_once(Picture&, const SharedPage&) const {}
  // Draw a frame.
  virtual void draw(Picture&, const Shot&) const {}
  virtual void draw_page(Picture&, const SharedPage&, int) const {}
};

using Layers = std::vector<std::unique_ptr<const Layer>>;

// Those that the stage's page shows, from the lowest to the highest. The stage must outlive them.
Layers layers_of(const Stage& stage);

}  // namespace chainreel
