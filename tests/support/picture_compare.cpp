#include "support/picture_compare.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/format.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

// Differences are made visible: a difference of 16 is already full black on white.
constexpr int kDeltaGain = 16;

Image delta_picture(const Image& a, const Image& b) {
  Image delta(a.width, a.height);
  for (std::size_t i = 0; i < a.bgra.size(); ++i) {
    const int difference = std::abs(int(a.bgra[i]) - int(b.bgra[i]));
    delta.bgra[i] = static_cast<std::uint8_t>(255 - std::min(255, kDeltaGain * difference));
  }
  // A difference in alpha alone must show as well.
  for (std::size_t i = 0; i < delta.bgra.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) delta.bgra[i + c] = std::min(delta.bgra[i + c], delta.bgra[i + 3]);
    delta.bgra[i + 3] = 255;
  }
  return delta;
}

std::string size_of(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

// Names may carry slashes: the folder is made.
std::string place_for(const std::string& folder, const std::string& file) {
  const fs::path path = fs::path(folder) / file;
  fs::create_directories(path.parent_path());
  return path.string();
}

::testing::AssertionResult compare_and_keep(const Image& actual, const Image& expected,
                                            PictureTolerance tolerance, const std::string& name,
                                            const std::string& failures) {
  const PictureDifference difference = compare_pictures(actual, expected);
  if (difference.same_size && difference.max <= tolerance.max && difference.mean <= tolerance.mean)
    return ::testing::AssertionSuccess();
  const std::string actual_path = place_for(failures, name + ".actual.png");
  const std::string expected_path = place_for(failures, name + ".expected.png");
  write_png(actual_path, actual);
  write_png(expected_path, expected);
  ::testing::AssertionResult failure = ::testing::AssertionFailure();
  failure << name << ": ";
  if (!difference.same_size)
    return failure << "the picture is " << size_of(actual) << ", expected " << size_of(expected) << "; see "
                   << actual_path << " and " << expected_path;
  const std::string delta_path = place_for(failures, name + ".delta.png");
  write_png(delta_path, delta_picture(actual, expected));
  return failure << "differs by at most " << difference.max << " (allowed " << tolerance.max << ") at pixel ("
                 << difference.x << ", " << difference.y << "), on average by "
                 << format_significant(difference.mean, 3) << " (allowed " << format_shortest(tolerance.mean)
                 << "); see " << actual_path << ", " << expected_path << " and " << delta_path;
}

std::string command_that_updates() {
  std::string command = "CHAINREEL_UPDATE_GOLDEN=1 ctest --test-dir " CHAINREEL_BINARY_FOLDER;
  if (const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info())
    command += std::string(" -R '^") + test->test_suite_name() + "\\." + test->name() + "$'";
  return command;
}

}  // namespace

Image over(const Image& image, int grey) {
  Image result = image;
  for (std::size_t i = 0; i < result.bgra.size(); i += 4) {
    const int a = image.bgra[i + 3];
    for (std::size_t c = 0; c < 3; ++c)
      result.bgra[i + c] = std::uint8_t((image.bgra[i + c] * a + grey * (255 - a) + 127) / 255);
    result.bgra[i + 3] = 255;
  }
  return result;
}

PictureDifference compare_pictures(const Image& a, const Image& b) {
  PictureDifference result;
  result.same_size = a.width == b.width && a.height == b.height && a.bgra.size() == b.bgra.size();
  if (!result.same_size) return result;
  result.max = 0;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.bgra.size(); ++i) {
    const int difference = std::abs(int(a.bgra[i]) - int(b.bgra[i]));
    sum += std::uint64_t(difference);
    if (difference <= result.max) continue;
    result.max = difference;
    result.x = int((i / 4) % std::size_t(a.width));
    result.y = int((i / 4) / std::size_t(a.width));
  }
  result.mean = a.bgra.empty() ? 0 : double(sum) / double(a.bgra.size());
  return result;
}

::testing::AssertionResult pictures_agree(const Image& actual, const Image& expected,
                                          PictureTolerance tolerance, const std::string& name) {
  return compare_and_keep(actual, expected, tolerance, name, CHAINREEL_BINARY_FOLDER "/picture-failures");
}

::testing::AssertionResult matches_golden(const Image& actual, const std::string& name,
                                          PictureTolerance tolerance) {
  const char* update = std::getenv("CHAINREEL_UPDATE_GOLDEN");
  return matches_golden(actual, name, tolerance,
                        {.goldens = CHAINREEL_SOURCE_FOLDER "/tests/golden",
                         .failures = CHAINREEL_BINARY_FOLDER "/picture-failures",
                         .update = update != nullptr && std::string_view(update) == "1"});
}

::testing::AssertionResult matches_golden(const Image& actual, const std::string& name,
                                          PictureTolerance tolerance, const GoldenPlaces& places) {
  const std::string golden = (fs::path(places.goldens) / (name + ".png")).string();
  if (places.update) {
    write_png(place_for(places.goldens, name + ".png"), actual);
    return ::testing::AssertionSuccess() << "wrote " << golden;
  }
  if (!fs::exists(golden)) {
    const std::string actual_path = place_for(places.failures, name + ".actual.png");
    write_png(actual_path, actual);
    return ::testing::AssertionFailure()
           << golden << " is missing. Look at " << actual_path << " and, if it is right, write it with\n  "
           << command_that_updates();
  }
  return compare_and_keep(actual, read_png(golden), tolerance, name, places.failures);
}

}  // namespace chainreel
