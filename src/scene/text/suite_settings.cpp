#include "scene/text/suite_settings.hpp"

#include <algorithm>
#include <set>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr int kLeastSide = 16, kLargestSide = 16384;  // pixels

std::optional<int> whole_number(const std::string& text, int least, int largest) {
  const std::optional<double> number = parse_number(text);
  if (!number || *number < least || *number > largest || *number != int(*number)) return std::nullopt;
  return int(*number);
}

void read_size(Fields& fields, SuiteSettings& settings) {
  if (!fields.has("size")) return;
  const YAML::Node node = fields.find("size");
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const std::size_t cross = text.find('x');
  const auto width = whole_number(text.substr(0, cross), kLeastSide, kLargestSide);
  const auto height = cross == std::string::npos
                          ? std::nullopt
                          : whole_number(text.substr(cross + 1), kLeastSide, kLargestSide);
  if (width && height)
    settings.size = {*width, *height};
  else
    fields.problem_at("size", "'" + fields.path("size") + "' must be width and height in pixels, each from " +
                                  std::to_string(kLeastSide) + " to " + std::to_string(kLargestSide) +
                                  ": size: 640x480");
}

void read_tolerance(Fields& fields, SuiteSettings& settings) {
  if (!fields.has("tolerance")) return;
  std::optional<Fields> tolerance =
      fields.section("tolerance", "what may differ: tolerance: {error: 0.1, pixels: 0, count_edges: false}");
  if (!tolerance) return;
  settings.tolerance_place = fields.place_of(fields.find("tolerance"), "tolerance");
  double error = 0;
  if (tolerance->has("error") && tolerance->read("error", error)) {
    if (error >= 0 && error <= 1)
      settings.error = error;
    else
      tolerance->problem_at(
          "error", "'" + tolerance->path("error") + "' is a perceptual difference from 0 to 1: 0.1 is good");
  }
  int pixels = 0;
  if (tolerance->has("pixels") && tolerance->read("pixels", pixels)) {
    if (pixels >= 0)
      settings.pixels = pixels;
    else
      tolerance->problem_at("pixels", "'" + tolerance->path("pixels") + "' is a number of pixels, 0 or more");
  }
  bool count_edges = false;
  if (tolerance->has("count_edges") && tolerance->read("count_edges", count_edges)) settings.count_edges = count_edges;
  tolerance->finish();
}

std::optional<std::array<int, 4>> box_of(const YAML::Node& node) {
  std::array<int, 4> box{};
  if (!node.IsSequence() || node.size() != box.size()) return std::nullopt;
  for (std::size_t i = 0; i < box.size(); ++i) {
    const bool is_length = i >= 2;
    const auto number =
        node[i].IsScalar() ? whole_number(node[i].Scalar(), is_length ? 1 : 0, kLargestSide) : std::nullopt;
    if (!number) return std::nullopt;
    box[i] = *number;
  }
  return box;
}

void read_masks(Fields& fields, SuiteSettings& settings) {
  if (!fields.has("masks")) return;
  const YAML::Node masks = fields.find("masks");
  const std::string wanted =
      "'" + fields.path("masks") +
      "' must be a list of boxes in whole pixels from the upper left: masks: [[x, y, width, height]]";
  if (!masks.IsSequence()) return fields.problem_at("masks", wanted);
  for (const YAML::Node& mask : masks)
    if (const auto box = box_of(mask))
      settings.masks.push_back(*box);
    else
      fields.problems().add(wanted, fields.place_of(mask, "masks"));
}

}  // namespace

void read_suite_settings(Fields& fields, SuiteSettings& settings) {
  read_size(fields, settings);
  read_tolerance(fields, settings);
  read_masks(fields, settings);
}

void apply(const SuiteSettings& settings, SuitePicture& picture) {
  if (settings.size) {
    picture.width = settings.size->width;
    picture.height = settings.size->height;
  }
  picture.masks.insert(picture.masks.end(), settings.masks.begin(), settings.masks.end());
  if (!settings.error && !settings.pixels && !settings.count_edges) return;
  SuiteTolerance& tolerance = picture.tolerance;
  tolerance = {settings.error.value_or(tolerance.error), settings.pixels.value_or(tolerance.pixels),
               settings.count_edges.value_or(tolerance.count_edges), settings.tolerance_place, false};
}

namespace {

// Whether the masks together leave no pixel: looked at once between any two neighbouring edges.
bool cover(const SuitePicture& picture) {
  long area = 0;
  for (const std::array<int, 4>& mask : picture.masks) area += long(mask[2]) * mask[3];
  if (area < long(picture.width) * picture.height) return false;
  std::set<int> columns{0}, rows{0};
  for (const auto& [x, y, width, height] : picture.masks) {
    columns.insert({x, x + width});
    rows.insert({y, y + height});
  }
  const auto is_masked = [&](int column, int row) {
    return column >= picture.width || row >= picture.height ||
           std::any_of(picture.masks.begin(), picture.masks.end(), [&](const std::array<int, 4>& mask) {
             return column >= mask[0] && column < mask[0] + mask[2] && row >= mask[1] && row < mask[1] + mask[3];
           });
  };
  return std::all_of(rows.begin(), rows.end(), [&](int row) {
    return std::all_of(columns.begin(), columns.end(), [&](int column) { return is_masked(column, row); });
  });
}

}  // namespace

void check_masks(const SuitePicture& picture, ProblemList& problems) {
  for (const auto& [x, y, width, height] : picture.masks)
    if (x + width > picture.width || y + height > picture.height)
      problems.add("the mask " + bracketed({double(x), double(y), double(width), double(height)}) +
                       " leaves the picture '" + picture.name + "' of " + std::to_string(picture.width) +
                       "x" + std::to_string(picture.height) + ": keep x + width and y + height within",
                   picture.place);
  if (!picture.masks.empty() && cover(picture))
    problems.add("the masks cover all of the picture '" + picture.name + "': nothing of it would be looked at",
                 picture.place);
}

}  // namespace chainreel
