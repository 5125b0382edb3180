#include "app/compare/comparison.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/report/compared_picture.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "encode/png.hpp"
#include "scene/text/scene_difference.hpp"

namespace chainreel {

std::string counted(long count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

namespace {

constexpr int kGap = 8;  // pixels between pictures that stand side by side

std::string size_of(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

Image side_by_side(const std::vector<const Image*>& images) {
  int width = kGap * (int(images.size()) - 1), height = 0;
  for (const Image* image : images) {
    width += image->width;
    height = std::max(height, image->height);
  }
  Image page(width, height);
  std::size_t left = 0;
  for (const Image* image : images) {
    const std::size_t bytes = std::size_t(4) * std::size_t(image->width);
    for (int y = 0; y < image->height; ++y)
      std::memcpy(&page.bgra[std::size_t(4) * (std::size_t(y) * std::size_t(width) + left)],
                  &image->bgra[std::size_t(y) * bytes], bytes);
    left += std::size_t(image->width + kGap);
  }
  return page;
}

// Empty where the file remembers nothing, or something that cannot be read.
std::optional<ClipMemory> memory_of(const std::string& path) {
  try {
    return recall(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::string told(const ImageDifference& d, const Image& before, const Image& after,
                 const ImageTolerance& tolerance) {
  if (!d.same_size) return "sizes differ: " + size_of(before) + " and " + size_of(after);
  if (d.is_equal()) return "equal";
  std::string text = counted(d.unequal, "pixel is", "pixels are") + " unequal";
  if (d.at_edges > 0)
    text += ", " + std::to_string(d.at_edges) + " of them at edges as anti-aliasing may make them";
  text += "; " + (d.beyond == 0 ? "none is" : counted(d.beyond, "is", "are")) + " beyond the error " +
          format_shortest(tolerance.error);
  if (tolerance.pixels > 0) text += " (" + std::to_string(tolerance.pixels) + " may)";
  text += ", worst " + format_significant(d.worst, 3) + ", mean " + format_significant(d.mean, 3) + ", in " +
          std::to_string(d.box.width) + "x" + std::to_string(d.box.height) + " at " +
          std::to_string(d.box.x) + " " + std::to_string(d.box.y);
  return text;
}

Json report_of(const ImageDifference& d, const Image& before, const Image& after) {
  if (!d.same_size)
    return {{"same_size", false}, {"sizes", {{before.width, before.height}, {after.width, after.height}}}};
  return {{"same_size", true},
          {"unequal", d.unequal},
          {"at_edges", d.at_edges},
          {"beyond", d.beyond},
          {"worst", d.worst},
          {"mean", d.mean},
          {"box", {d.box.x, d.box.y, d.box.width, d.box.height}}};
}

void write_difference(const CompareOptions& options, const Image& before, const Image& after,
                      const std::string& path) {
  const Image difference = difference_picture(before, after, options.tolerance);
  OutputFile file(path, options.common.force);
  const Image page = difference.bgra.empty() ? side_by_side({&before, &after})
                     : options.side_by_side  ? side_by_side({&before, &after, &difference})
                                             : difference;
  write_png(file.temporary_path(), page, compared_picture_text());
  file.commit();
}

// Of what both were made with; pictures need fewer libraries than films.
bool has_other_versions(const Json& before, const Json& after) {
  for (const auto& [name, version] : before.items())
    if (after.contains(name) && after[name] != version) return true;
  return false;
}

namespace {

// Where the scenes ask for the same picture and the camera moved all the same, every pixel is another one.
std::optional<std::string> words_of_view(const Json& before, const Json& after) {
  if (!before.is_object() || !after.is_object() || before == after) return std::nullopt;
  const double old = before.value("height", 0.0), now = after.value("height", 0.0);
  const std::string heights = format_significant(old, 4) == format_significant(now, 4)
                                  ? "another part of the scene"
                                  : format_significant(old, 4) + " m -> " + format_significant(now, 4) + " m of height";
  return "the camera, which is fitted to the motion, shows " + heights + ", so that all that stands still has moved, too: `camera: {fit: [left, bottom, right, top]}` keeps it";
}

}  // namespace

std::vector<std::string> explain_memories(const std::string& before, const std::string& after) {
  const std::optional<ClipMemory> old = memory_of(before), now = memory_of(after);
  if (!old && !now) return {};
  if (!old || !now)
    return {"only " + (old ? before : after) +
            " remembers what it shows: there is nothing to explain the pixels by"};
  return explain_memories(*old, *now);
}

ModelFiles compare_model_files(const Json& before, const Json& after) {
  const auto is_same = [&](const char* key) { return word_of(before, key) == word_of(after, key); };
  constexpr const char* kElements = "model_elements_sha256";
  if (is_same("model_sha256")) return ModelFiles::same;
  return is_same(kElements) && !word_of(before, kElements).empty() ? ModelFiles::other_comments : ModelFiles::other;
}

std::vector<std::string> explain_memories(const ClipMemory& old, const ClipMemory& now) {
  if (old.figure.is_null() != now.figure.is_null()) return {"one shows a scene, the other is a figure"};
  std::vector<std::string> sentences;
  if (!old.figure.is_null()) {
    const std::string command = command_line(old.figure), other = command_line(now.figure);
    if (command != other) sentences.push_back("command: " + command + " -> " + other);
  } else {
    try {
      sentences = explain_scene_texts(old.scene, now.scene);
    } catch (const Error& error) {
      sentences.push_back(std::string("what one of them remembers cannot be read as a scene: ") +
                          error.what());
    }
  }
  const Json& facts = old.figure.is_null() ? old.audit : old.figure;
  const Json& other_facts = now.figure.is_null() ? now.audit : now.figure;
  const auto differs = [&](const char* key) { return facts.value(key, Json()) != other_facts.value(key, Json()); };
  if (const ModelFiles models = compare_model_files(facts, other_facts); models == ModelFiles::other)
    sentences.push_back(std::string("the model file is another one") + kByHash);
  else if (models == ModelFiles::other_comments)
    sentences.push_back(std::string("the model file has other comments or line breaks, and says the same") + kByHash);
  // A film's motion and that up to one instant are hashed at other instants.
  if (differs("trajectory_sha256") && !differs("at") && !differs("frames") && !differs("fps"))
    sentences.push_back(std::string("the motion at the frames is another one") + kByHash);
  const bool says_slow_motion = std::any_of(sentences.begin(), sentences.end(), [](const std::string& one) { return one.starts_with("slow_motion"); });
  if (old.figure.is_null() && differs("slow_motion") && !says_slow_motion)
    sentences.push_back("slow motion, which films have by themselves, is at other places, so that frames show other instants: `slow_motion: none` leaves it out");
  const bool says_camera = std::any_of(sentences.begin(), sentences.end(), [](const std::string& one) { return one.starts_with("camera") || one.starts_with("video"); });
  if (const auto words = words_of_view(facts.value("view", Json()), other_facts.value("view", Json())); words && !says_camera)
    sentences.push_back(*words);
  if (has_other_versions(facts.value("versions", Json()), other_facts.value("versions", Json())))
    sentences.push_back("versions of the program or its libraries are others");
  return sentences;
}

bool ends_in(const std::string& path, std::initializer_list<const char*> endings) {
  const std::string ending = lower_case_ending(path);
  return std::any_of(endings.begin(), endings.end(), [&](const char* one) { return ending == one; });
}

}  // namespace chainreel
