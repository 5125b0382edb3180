#include "app/verify/verdict.hpp"

#include <algorithm>
#include <array>

#include "app/verify/physics_record.hpp"
#include "app/verify/shapes_there.hpp"
#include "core/format.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

constexpr Name kStates[] = {{"same", "physics and pixels are those of the baseline"},
                            {"rendered", "the same physics; pixels differ within the tolerance"},
                            {"pixels", "the same physics, other pixels"},
                            {"looks", "the same model and motion, of which the scene or the model's file asks for another look"},
                            {"physics", "other physics, the same pixels"},
                            {"changed", "other physics and other pixels"},
                            {"size", "another size than the baseline"},
                            {"missing", "there is no baseline"},
                            {"baseline", "the baseline cannot be used"},
                            {"failed", "the picture cannot be drawn"},
                            {"accepted", "taken as the new baseline"}};

// Half a pixel: how far anti-aliasing may see an edge from where it lies.
constexpr std::array<std::array<double, 2>, 4> kHalves = {{{0.5, 0}, {-0.5, 0}, {0, 0.5}, {0, -0.5}}};

Envelope envelope_of(const SuiteShot& shot, Studio& studio) {
  std::vector<Image> moved;
  for (const auto& [right, up] : kHalves) moved.push_back(studio.moved(shot, right, up));
  return envelope_of(shot.image, moved);
}

ImageTolerance tolerance_of(const SuitePicture& picture) {
  ImageTolerance tolerance{picture.tolerance.error, picture.tolerance.pixels, {}};
  for (const auto& [x, y, width, height] : picture.masks) tolerance.masks.push_back({x, y, width, height});
  return tolerance;
}

std::string place_text(const Place& place) {
  return place.line > 0 ? place.file + ":" + std::to_string(place.line) : place.file;
}

std::string tolerance_text(const SuitePicture& picture) {
  const SuiteTolerance& tolerance = picture.tolerance;
  return "error " + format_shortest(tolerance.error) + ", " + std::to_string(tolerance.pixels) + " pixels" + (tolerance.count_edges ? ", edges counted" : "") +
         (tolerance.is_default ? " (default)" : " (" + place_text(tolerance.place) + ")");
}

// Physics that differ, the cause first.
std::vector<std::string> physics_words(const Json& before, const Json& now) {
  if (before == now) return {};
  std::vector<std::string> words;
  const auto add = [&](std::vector<std::string> more) {
    for (std::string& one : more) words.push_back(std::move(one));
  };
  if (before.value("source", Json()) != now.value("source", Json()))
    words.push_back("source: " + before.value("source", Json("none")).dump() + " -> " + now["source"].dump());
  if (before.contains("model") && now.contains("model")) {
    add(explain_models(before.at("model"), now["model"]));
    const auto names = now["names"].get<std::vector<std::string>>();
    if (before.value("names", Json()) == now["names"])
      add(explain_poses(before.at("q").get<std::vector<double>>(), now["q"].get<std::vector<double>>(), names,
                        now["model"]));
  } else if (before.contains("run") && now.contains("run")) {
    if (before.at("t") != now["t"])
      words.push_back("instant: t = " + format_shortest(before.at("t").get<double>()) + " s -> " +
                      format_shortest(now["t"].get<double>()) + " s");
    add(explain_runs(before.at("run"), now["run"]));
  } else {
    words.push_back("it was a picture of a model and is one of a scene, or the other way round");
  }
  return words;
}

// Records that differ, though nothing that moves does.
bool have_same_motion_in_other_looks(const Json& before, const Json& now) {
  for (const char* own : {"source", "q", "t"})
    if (before.value(own, Json()) != now.value(own, Json())) return false;
  for (const char* record : {"model", "run"})
    if (before.contains(record) && now.contains(record)) return differ_in_looks_alone(before.at(record), now.at(record));
  return false;
}

// What of a model's changes is seen otherwise than one thinks: bars show neither shapes nor colours, and shapes show limits.
std::vector<std::string> shape_words(const Json& before, const SuiteShot& shot, bool same_pixels) {
  const auto has_changed = [&](ModelChange change) {
    return std::ranges::any_of(std::array{"model", "run"}, [&](const char* record) {
      return before.contains(record) && shot.physics.contains(record) && have_change(before.at(record), shot.physics[record], change);
    });
  };
  if (shot.has_bars && has_changed(ModelChange::looks))
    return {"the model is drawn as bars, which show neither shapes nor colours of its file: "
            "`links: visual` in the suite shows them"};
  if (!shot.has_bars && !same_pixels && has_changed(ModelChange::limit))
    return {"limits are seen, too: links shade one another over the ranges of their joints"};
  return {};
}

// All else that pixels depend on.
std::vector<std::string> page_words(const Json& before, const Json& now) {
  std::vector<std::string> words;
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  for (const char* key : {"theme", "camera", "program", "renderer", "processor"})
    if (before.value(key, Json()) != now.value(key, Json()))
      words.push_back(std::string(key) + ": " + text(before.value(key, Json("unknown"))) + " -> " +
                      text(now.value(key, Json("unknown"))));
  // What the suite itself says of the look of its models.
  const Json keys_before = before.value("keys", Json::array()), keys = now.value("keys", Json::array());
  const auto missing_in = [](const Json& list, const Json& key) {
    return std::find(list.begin(), list.end(), key) == list.end();
  };
  for (const Json& key : keys_before)
    if (missing_in(keys, key)) words.push_back("the suite no longer says " + text(key));
  for (const Json& key : keys)
    if (missing_in(keys_before, key)) words.push_back("the suite now says " + text(key));
  const Json fonts_before = before.value("fonts", Json::object()), fonts = now.value("fonts", Json::object());
  for (const auto& [file, hash] : fonts.items())
    if (fonts_before.value(file, Json()) != hash)
      words.push_back(
          "font " + file +
          (fonts_before.contains(file) ? ": another version of the file" : ": was not used before"));
  return words;
}

bool has_same_motion(const Json& before, const Json& now) {
  return before.contains("run") && now.contains("run") && before.value("source", Json()) == now.value("source", Json()) &&
         before.at("t") == now.at("t") && is_same_motion(before.at("run"), now.at("run"));
}

std::string pixel_words(const SuitePicture& picture, const ImageDifference& difference) {
  if (difference.is_equal())
    return picture.masks.empty() ? "the same pixels" : "the same pixels outside of the masks";
  const PixelBox& box = difference.box;
  return std::to_string(difference.unequal) + " pixels differ: " + std::to_string(difference.at_edges) +
         " by anti-aliasing, " + std::to_string(difference.beyond) + " beyond the tolerance (largest error " +
         format_significant(difference.worst, 3) + ") in " + std::to_string(box.width) + " x " +
         std::to_string(box.height) + " at " + std::to_string(box.x) + ", " + std::to_string(box.y);
}

}  // namespace

std::span<const Name> names_of(PictureState) {
  return kStates;
}

PictureVerdict without(PictureState state, const Suite& suite, const SuitePicture& picture,
                       std::vector<std::string> why) {
  PictureVerdict verdict;
  verdict.name = picture.name;
  verdict.source = source_name(suite, picture);
  verdict.state = state;
  verdict.passes = state == PictureState::accepted;
  verdict.words = std::move(why);
  verdict.tolerance = tolerance_text(picture);
  return verdict;
}

PictureVerdict judge(const Suite& suite, const SuitePicture& picture, const SuiteShot& shot,
                     const Baseline& baseline, Studio& studio) {
  PictureVerdict verdict = without(PictureState::same, suite, picture, {});
  const ImageTolerance tolerance = tolerance_of(picture);
  verdict.words = physics_words(baseline.physics, shot.physics);
  const bool same_physics = verdict.words.empty();
  verdict.difference = compare_images(baseline.image, shot.image, tolerance);
  if (!verdict.difference.is_equal() && verdict.difference.same_size) {
    // The shapes are those of what is drawn now: it says where the baseline's pixels may lie.
    std::optional<Envelope> envelope;
    if (!picture.tolerance.count_edges) envelope = envelope_of(shot, studio);
    const Envelope* const edges = envelope ? &*envelope : nullptr;
    verdict.difference = compare_images(shot.image, baseline.image, tolerance, edges);
    verdict.difference_png = png_bytes(difference_picture(shot.image, baseline.image, tolerance, edges));
  }
  const ImageDifference& difference = verdict.difference;
  // One renderer gives one picture of one physics; what differs by less than an eye sees has a cause all the same. Who sets
  // a tolerance means it.
  const bool same_page = baseline.page == shot.page, is_exact = same_page && same_physics && picture.tolerance.is_default;
  const bool same_pixels = difference.is_equal(),
             near = is_exact ? same_pixels : difference.passes(tolerance);
  if (!difference.same_size) {
    verdict.state = PictureState::size;
    verdict.words.insert(verdict.words.begin(),
                         "the baseline has " + std::to_string(baseline.image.width) + " x " +
                             std::to_string(baseline.image.height) + " pixels, the picture " +
                             std::to_string(shot.image.width) + " x " + std::to_string(shot.image.height));
  } else if (same_physics) {
    verdict.state = same_pixels ? PictureState::same : near ? PictureState::rendered : PictureState::pixels;
  } else if (have_same_motion_in_other_looks(baseline.physics, shot.physics)) {
    verdict.state = PictureState::looks;
  } else {
    verdict.state = same_pixels ? PictureState::physics : PictureState::changed;
  }
  const bool same_enough = same_physics || suite.other_physics == OtherPhysics::note ||
                           (suite.other_physics == OtherPhysics::motion && has_same_motion(baseline.physics, shot.physics));
  verdict.passes = difference.same_size && same_enough && near;
  if (verdict.state == PictureState::same) return verdict;
  for (std::string& words : page_words(baseline.page, shot.page)) verdict.words.push_back(std::move(words));
  if (difference.same_size) verdict.words.push_back(pixel_words(picture, difference));
  for (std::string& words : shape_words(baseline.physics, shot, same_pixels)) verdict.words.push_back(std::move(words));
  if (is_exact && difference.same_size && !same_pixels)
    verdict.words.push_back(
        "program, renderer, processor and fonts are those of the baseline, so its very pixels are expected");
  if (difference.same_size && !same_pixels)
    verdict.words.push_back("there: " + shapes_there(shot.picture, shot.height, difference.box));
  if (shot.leaves_camera) verdict.words.push_back(kLeavesCamera);
  verdict.expected_png = baseline.png;
  verdict.actual_png = png_bytes(shot.image);
  return verdict;
}

std::vector<std::string> SaidOnce::words_of(const PictureVerdict& verdict) {
  std::vector<std::string> words;
  std::string as;
  for (const std::string& one : verdict.words) {
    const auto [before, is_new] = first_.try_emplace(one, verdict.name);
    if (is_new)
      words.push_back(one);
    else if (as.empty())
      as = before->second;
  }
  if (!as.empty()) words.insert(words.begin(), "as " + as);
  return words;
}

}  // namespace chainreel
