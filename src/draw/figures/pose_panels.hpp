// Where the panels of a figure of poses lie, and what stands below each. Internal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/figures/caption.hpp"
#include "draw/figures/ellipse_figure.hpp"
#include "draw/robot/skeleton.hpp"

namespace chainreel {

inline constexpr std::size_t kManyPoses = 5;   // have one line of caption each
inline constexpr double kLabelInset = 0.014;  // of words in a panel's corner

// What all panels share.
struct Panels {
  const Chain& chain;
  const PageInUnits& page;
  const Fonts& fonts;
  const PoseFigureOptions& options = page.options;
  std::vector<Rect> places{};
  double caption = 0;                           // height of the words of each scene
  double beside = 0;                            // their width where they stand beside it; else they stand below
  std::vector<std::vector<std::string>> lines{};  // one a panel, where that is its whole caption
  CaptionLines words{};                           // what of them is written; else the poses above their numbers
  std::vector<std::vector<std::string>> below{};  // further lines of such captions, one a panel each
  bool has_masses = true;                       // below the scenes
  UnderPoses under = UnderPoses::named;         // what of the captions the sheet names
  double filled = 1;                            // the share of a scene that is kept when it is cut to content
  double marks = 1;
  EllipseScale scale{};
  double widest_link = size::kLinkWidth;
  Skeleton skeleton{};
  Camera camera{};  // of the first panel

  Rect scene(std::size_t i) const {
    const Rect& place = places[i];
    return beside > 0 ? Rect{place.x0, place.y0, place.x1 - beside, place.y1} : Rect{place.x0, place.y0 + caption, place.x1, place.y1};
  }
  // What is framed: the words beside a scene with it.
  Rect frame(std::size_t i) const { return beside > 0 ? places[i] : scene(i); }
  Rect words_box(std::size_t i) const {
    const Rect &place = places[i], seen = scene(i);
    if (!(beside > 0)) return {seen.x0, place.y0, seen.x1, seen.y0};
    const double middle = (place.y0 + place.y1) / 2;
    return {seen.x1, middle - caption / 2, place.x1 - kLabelInset, middle + caption / 2};
  }
  // Where the chain may be: below the words in its corner.
  Rect picture(std::size_t i) const {
    Rect rest = scene(i);
    if (!options.labels.empty()) rest.y1 -= kLabelInset + scaled(size::kAxis, options.text_scale);
    return rest;
  }
  double side() const { return std::min(picture(0).width(), picture(0).height()); }
};

// Whether semi-axes may have their numbers: small panels have no room for them.
bool has_lengths(const Panels& panels);
// ... and whether the captions have them anyway.
bool tells_lengths_below(const Panels& panels);
// The best of all arrangements that there are; nothing where none has room.
std::optional<Panels> best_panels(const Chain& chain, const std::vector<Pose>& poses, const PageInUnits& page, const Fonts& fonts,
                                  Workspace& ws);
// Panels that are narrow for what they show are no higher than it needs, or than they are wide, and stand in the middle of `area`.
void cut_to_content(Panels& panels, const Rect& area, const std::vector<Pose>& poses, Workspace& ws);
// Whether a panel of many has most of its cell, a caption of one line or of several the rest.
bool is_mostly_picture(const Panels& panels);
// Whether a pose below its panel is shortened.
bool has_cut_captions(const Panels& panels);

}  // namespace chainreel
