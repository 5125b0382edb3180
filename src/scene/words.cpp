#include "scene/words.hpp"

namespace chainreel {
namespace {

constexpr Name kRootLinks[] = {{"fixed", "to the world"}, {"floating", "on a floating joint"}};
constexpr Name kOutcomes[] = {{"finish", "come to its end"},
                              {"diverge", "blow up: the picture then stands still, and the exit code is 0"},
                              {"within_limits", "come to its end, and no joint pass a limit of its position, rate or effort (with `limit: clamp` no effort is passed): else the exit code is 7"}};
constexpr Name kLinkShapes[] = {{"auto", "visual in space and where the view is oblique, with bodies made where it shows none; else plain"},
                                {"plain", "bars from joint to joint"},
                                {"visual", "the model's <visual> shapes"},
                                {"collision", "the model's <collision> shapes"}};
constexpr Name kReadings[] = {{"mass", "forces for unit accelerations; semi-axes in kg"},
                              {"energy", "velocities of a kinetic energy of 0.5 J; semi-axes in m/s"},
                              {"belt", "the mass felt along each direction, kg"}};
constexpr Name kEllipseShapes[] = {{"ellipsoid", "whole"},
                                   {"section", "cut by the xy plane of the end effector"}};
constexpr Name kLayouts[] = {{"auto",
                              "as `scene`, with a plot of what tells its story where that takes nothing from the motion"},
                             {"scene", "the scene, plots beside it where there are two or three"},
                             {"scene-below", "plots below the scene"},
                             {"scene-right", "plots beside the scene"},
                             {"transparent", "the motion alone on nothing, for overlays"},
                             {"compare", "two panels side by side"},
                             {"grid", "up to twelve panels"},
                             {"ghost", "two to four variants over one another, all but the first in outline"}};
constexpr Name kThemes[] = {{"light", "on white"}, {"dark", "for dark slides"}};
constexpr Name kPresets[] = {{"slides", "NAME.mp4"},
                             {"web", "NAME.webm and its first frame"},
                             {"overlay", "NAME.mov and NAME.webm, transparent"},
                             {"doc", "NAME.gif"},
                             {"frames", "a folder of PNG files"},
                             {"still", "one frame as PNG, SVG and PDF"}};

}  // namespace

std::span<const Name> names_of(RootLink) {
  return kRootLinks;
}

std::span<const Name> names_of(Outcome) {
  return kOutcomes;
}

std::span<const Name> names_of(LinkShapes) {
  return kLinkShapes;
}

std::span<const Name> names_of(EllipseReading) {
  return kReadings;
}

std::span<const Name> names_of(EllipseShape) {
  return kEllipseShapes;
}

std::span<const Name> names_of(PageLayout) {
  return kLayouts;
}

std::span<const Name> names_of(ThemeName) {
  return kThemes;
}

std::span<const Name> names_of(Preset) {
  return kPresets;
}

}  // namespace chainreel
