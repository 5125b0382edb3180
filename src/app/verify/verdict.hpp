// What a picture of a suite has become since it was accepted: its physics first, then its pixels.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/verify/baselines.hpp"
#include "app/verify/shots.hpp"
#include "compare/compare_images.hpp"
#include "core/names.hpp"

namespace chainreel {

enum class PictureState {
  same,      // physics and pixels
  rendered,  // the same physics; pixels differ within the tolerance
  pixels,    // the same physics, other pixels
  looks,     // the same motion, asked for with another look
  physics,   // other physics, the same pixels
  changed,   // both
  size,      // it has another size: nothing else can be compared
  missing,   // no baseline
  baseline,  // its baseline cannot be read
  failed,    // it cannot be drawn
  accepted,  // taken as the new baseline
};
std::span<const Name> names_of(PictureState);

struct PictureVerdict {
  std::string name;
  std::string source;
  PictureState state = PictureState::same;
  bool passes = true;
  std::vector<std::string> words;  // why, the cause first
  ImageDifference difference;
  std::string tolerance;  // which one held, and where it was set
  // PNG files of what failed: its baseline, what is drawn now, where they differ. Empty where there is none.
  std::string expected_png, actual_png, difference_png;
};

inline constexpr const char* kLeavesCamera =
    "it is cut off at the edge of the camera that the baselines were accepted with: --accept --refit takes a camera that holds it";

// What pictures have in common is said once: of each the words that none before had, behind "as reach_light" where there were some.
class SaidOnce {
 public:
  std::vector<std::string> words_of(const PictureVerdict& verdict);

 private:
  std::map<std::string, std::string> first_;  // sentence, and the picture that had it first
};

// What is drawn now against its baseline.
PictureVerdict judge(const Suite& suite, const SuitePicture& picture, const SuiteShot& shot,
                     const Baseline& baseline, Studio& studio);
// Where one of the two is not to be had: `why` in words.
PictureVerdict without(PictureState state, const Suite& suite, const SuitePicture& picture,
                       std::vector<std::string> why);

}  // namespace chainreel
