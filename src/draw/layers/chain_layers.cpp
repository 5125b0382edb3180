// The layers `chain`: what stands on the ground, rails below a trail, links over it, and the end effector above all
// marks. A run that is drawn over another one has its chain in outline.
#include <cmath>

#include "draw/layers/layer.hpp"
#include "draw/layers/past.hpp"
#include "draw/robot/chain.hpp"

namespace chainreel {
namespace {

constexpr double kOutlineHalo = 1.8;  // times an outline's width: sets it off from what is filled below
constexpr double kWiderJoint = 1.3, kWiderRail = 1.15, kWiderTip = 1.8;
constexpr double kStoodStill = 0.4;    // strength of a run that left the picture
constexpr double kLetterTurn = 0.75;   // rad
constexpr double kLetterAway = 0.020;  // and more than half its size, from the end effector, units of H

class ChainBase : public Layer {
 public:
  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw_once(Picture& picture, const Panel& panel) const override {
    const StagedRun& motion = panel.motion();
    if (!motion.has_foot()) draw_base(picture, panel.drawing(), panel.clip());
    if (motion.is_constrained())
      draw_closure_pins(picture, panel.drawing(), motion.simulation()->constraints, panel.clip());
  }
};

class ChainRails : public Layer {
 public:
  UnderWords under_words() const override { return UnderWords::if_need_be; }

  void draw(Picture& picture, const Shot& shot) const override {
    draw_rails(picture, shot.panel.drawing(), shot.ws, shot.panel.clip());
  }
};

class ChainLinks : public Layer {
 public:
  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    draw_links(picture, panel.drawing(), shot.ws, panel.clip());
    if (panel.motion().is_constrained())
      draw_closure_joints(picture, panel.drawing(), shot.ws, panel.motion().simulation()->constraints,
                          panel.clip());
  }
};

class ChainTip : public Layer {
 public:
  explicit ChainTip(const Stage& stage) : has_trail_(stage.shows("trail")) {}

  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    if (has_trail_ && is_followed_by_center(panel.chain())) draw_center_of_mass(picture, panel.tip().place(shot.k), panel.look(), panel.clip());
    if (!panel.motion().shapes() && panel.chain().end_effector >= 0)
      draw_end_effector(picture, panel.tip().place(shot.k), panel.look(), panel.clip());
  }

 private:
  bool has_trail_;
};

// Colours and sizes of a chain in outline: wider than what is filled, so that both are seen where the runs agree.
ChainLook outline_look(const Shot& shot) {
  ChainLook look = shot.panel.look();
  look.filled = false;
  look.link_width += 2 * kOutlineAway;
  look.joint_disc *= kWiderJoint;
  look.rails *= kWiderRail;
  if (shot.is_over && shot.panel.motion().may_freeze()) look.strength = kStoodStill;
  return look;
}

class Outlined : public Layer {
 public:
  bool is_of(const StagedRun& motion) const override { return motion.is_outlined(); }
};

class OutlinedTrail : public Outlined {
 public:
  explicit OutlinedTrail(const Stage& stage) : on_rails_(runs_on_rails(stage)) {}

  UnderWords under_words() const override { return UnderWords::freely; }

  void draw(Picture& picture, const Shot& shot) const override {
    if (on_rails_.contains(&shot.panel.motion())) return;
    const Color color = shot.panel.motion().variant()->color;
    const Theme& theme = *shot.panel.look().theme;
    draw_trail(picture, shot.panel.tip(), shot.k, toned(color, outline_look(shot)), shot.panel.clip(), theme.lines, theme.trail, trail_opacity(theme),
               longest_trail(shot.panel));
  }

 private:
  std::set<const StagedRun*> on_rails_;
};

class OutlinedChain : public Outlined {
 public:
  explicit OutlinedChain(const Stage& stage) : fonts_(&stage.fonts), text_scale_(stage.page.text_scale) {}

  // Twice: as wide lines in the background's colour, and on them the outline itself.
  void draw(Picture& picture, const Shot& shot) const override {
    const Panel& panel = shot.panel;
    const Point tip = end_of(shot);
    ChainLook look = outline_look(shot);
    Theme line = *look.theme, halo = *look.theme;
    line.ink = panel.motion().variant()->color;
    halo.ink = halo.background;
    for (const bool is_halo : {true, false}) {
      look.theme = is_halo ? &halo : &line;
      look.stroke = (is_halo ? kOutlineHalo : 1) * look.theme->lines;
      ChainDrawing drawing = panel.drawing(look);
      drawing.shapes = nullptr;
      draw_rails(picture, drawing, shot.ws, panel.clip());
      draw_links(picture, drawing, shot.ws, panel.clip());
      if (panel.motion().is_constrained())
        draw_closure_joints(picture, drawing, shot.ws, panel.motion().simulation()->constraints, panel.clip());
      if (panel.chain().end_effector < 0) continue;
      const double r = kWiderTip * look.marks * size::kEndEffector / 2;
      picture.add(
          Ellipse{tip, {r, 0}, {0, r}, {{}, toned(look.theme->ink, look), look.stroke * size::kLinkOutline}},
          panel.clip());
    }
    draw_letter(picture, shot, tip, toned(line.ink, look));
  }

 private:
  // The end effector, else the end of the last link.
  static Point end_of(const Shot& shot) {
    if (shot.panel.chain().end_effector >= 0) return shot.panel.tip().place(shot.k);
    const std::vector<LinkSegment>& links = shot.panel.motion().skeleton().links;
    if (links.empty()) return {};
    return shot.panel.camera().project(pose_of(shot.ws, links.back().body) * links.back().to);
  }

  // Beyond the end of the chain.
  void draw_letter(Picture& picture, const Shot& shot, Point tip, Color color) const {
    const Panel& panel = shot.panel;
    const std::string& letter = panel.motion().variant()->letter;
    const std::vector<LinkSegment>& links = panel.motion().skeleton().links;
    if (letter.empty() || links.empty()) return;
    const Point joint = panel.camera().project(pose_of(shot.ws, links.back().body) * links.back().from);
    const double em = scaled(size::kAxis, text_scale_);
    // Each turned a little more than the one before, so that they stand apart where the runs agree.
    const double turn = kLetterTurn * (letter[0] - 'C');
    const Point along = unit(tip - joint), side = normal_to(along);
    const Point away = tip + (kLetterAway + 0.6 * em) * (std::cos(turn) * along + std::sin(turn) * side);
    const TextLine line = lay_out_text(*fonts_, letter, {Face::label_bold, em, color, Align::center});
    const double middle = (line.box.y0 + line.box.y1) / 2;
    draw_text(picture, line, {away.x, away.y - middle});
  }

  const Fonts* fonts_;
  double text_scale_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_chain_base(const Stage&) {
  return std::make_unique<ChainBase>();
}
std::unique_ptr<const Layer> make_layer_chain_rails(const Stage&) {
  return std::make_unique<ChainRails>();
}
std::unique_ptr<const Layer> make_layer_chain_links(const Stage&) {
  return std::make_unique<ChainLinks>();
}
std::unique_ptr<const Layer> make_layer_chain_tip(const Stage& stage) {
  return std::make_unique<ChainTip>(stage);
}
std::unique_ptr<const Layer> make_layer_outlined_trail(const Stage& stage) {
  return std::make_unique<OutlinedTrail>(stage);
}
std::unique_ptr<const Layer> make_layer_outlined_chain(const Stage& stage) {
  return std::make_unique<OutlinedChain>(stage);
}

}  // namespace chainreel
