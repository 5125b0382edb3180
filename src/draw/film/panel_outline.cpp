// A panel that is drawn over another one, in outline.

#include <algorithm>
#include <cmath>

#include "draw/film/ghost_layout.hpp"
#include "draw/film/panel.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/chain.hpp"
#include "draw/robot/joints.hpp"

namespace chainreel {
namespace {

constexpr double kOutlineHalo = 1.8;  // times an outline's width: sets it off from what is filled below
constexpr double kWiderJoint = 1.3, kWiderRail = 1.15, kWiderTip = 1.8;
constexpr double kStoodStill = 0.4;    // strength of a run that left the picture
constexpr double kLetterTurn = 0.75;   // rad
constexpr double kLetterAway = 0.020;  // and more than half its size, from the end effector, units of H

}  // namespace

void Panel::draw_in_outline(Color color, const std::string& letter) {
  outline_ = std::make_unique<Theme>(theme_);
  outline_->ink = color;
  letter_ = letter;
}

void Panel::reach_as_far_as(const Panel& other) {
  for (Rail& rail : skeleton_.rails)
    for (const Rail& its : other.skeleton_.rails) {
      if (its.body != rail.body || !its.used || !rail.used) continue;
      rail.lower = std::min(rail.lower, its.lower);
      rail.upper = std::max(rail.upper, its.upper);
    }
}

// Wider than what is filled, so that both are seen where the runs agree. Twice: as wide lines in the
// background's colour, and on them the outline itself.
void Panel::draw_outline(Picture& picture, int k, const Fonts& fonts) const {
  ChainLook look = look_;
  look.filled = false;
  look.link_width += 2 * kOutlineAway;
  look.joint_disc *= kWiderJoint;
  look.rails *= kWiderRail;
  if (may_freeze() && k > last_) look.strength = kStoodStill;
  k = std::clamp(k, 0, last_);
  pose_at(k);
  // Where there is no end effector the letter stands at the end of the last link.
  const bool has_tip = run_.chain.end_effector >= 0;
  const Point tip = has_tip                  ? tip_.place(k)
                    : skeleton_.links.empty() ? Point{}
                                              : camera_.project(pose_of(*ws_, skeleton_.links.back().body) *
                                                                skeleton_.links.back().to);
  Theme halo_theme = *outline_;
  halo_theme.ink = outline_->background;
  if (layers_.trail) draw_trail(picture, tip_, k, toned(outline_->ink, look), clip_);
  if (!layers_.chain) return;
  for (const bool halo : {true, false}) {
    look.theme = halo ? &halo_theme : outline_.get();
    look.stroke = halo ? kOutlineHalo : 1;
    const ChainDrawing drawing{run_.chain, skeleton_, camera_, look};
    draw_rails(picture, drawing, *ws_, clip_);
    draw_links(picture, drawing, *ws_, clip_);
    if (is_constrained()) draw_closure_joints(picture, drawing, *ws_, run_.simulation->constraints, clip_);
    if (!has_tip) continue;
    const double r = kWiderTip * look.marks * size::kEndEffector / 2;
    picture.add(
        Ellipse{tip, {r, 0}, {0, r}, {{}, toned(look.theme->ink, look), look.stroke * size::kLinkOutline}},
        clip_);
  }
  draw_letter(picture, tip, toned(outline_->ink, look), fonts);
}

// Beyond the end of the chain.
void Panel::draw_letter(Picture& picture, Point tip, Color color, const Fonts& fonts) const {
  if (letter_.empty() || skeleton_.links.empty()) return;
  const LinkSegment& last = skeleton_.links.back();
  const Point joint = camera_.project(pose_of(*ws_, last.body) * last.from);
  const double em = scaled(size::kAxis, run_.scene.text_scale);
  // Each turned a little more than the one before, so that they stand apart where the runs agree.
  const double turn = kLetterTurn * (letter_[0] - 'C');
  const Point along = unit(tip - joint), side = normal_to(along);
  const Point away = tip + (kLetterAway + 0.6 * em) * (std::cos(turn) * along + std::sin(turn) * side);
  const TextLine line = lay_out_text(fonts, letter_, {Face::label_bold, em, color, Align::center});
  const double middle = (line.box.y0 + line.box.y1) / 2;
  draw_text(picture, line, {away.x, away.y - middle});
}

}  // namespace chainreel
