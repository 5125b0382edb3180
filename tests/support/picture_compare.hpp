// Pictures against pictures: the largest and the mean difference of a channel, and the golden workflow on
// top.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/image.hpp"

namespace chainreel {

// Differences of 8-bit channels; alpha counts as a channel.
struct PictureDifference {
  bool same_size = false;
  int max = 255;
  double mean = 255;   // over all channels of all pixels
  int x = -1, y = -1;  // where the largest difference is; -1 where there is none
};

PictureDifference compare_pictures(const Image& a, const Image& b);

// The picture, whose opacity is straight, as a compositing program lays it on a grey.
Image over(const Image& image, int grey);

struct PictureTolerance {
  int max = 0;
  double mean = 0;
};

// Within both bounds. Otherwise both pictures and their difference are left in the build folder, under
// `name`, and the message says where.
::testing::AssertionResult pictures_agree(const Image& actual, const Image& expected,
                                          PictureTolerance tolerance, const std::string& name);

// Against tests/golden/NAME.png. A missing golden is a failure that tells the command which writes it; with
// the environment variable CHAINREEL_UPDATE_GOLDEN=1 the golden is written from `actual`.
::testing::AssertionResult matches_golden(const Image& actual, const std::string& name,
                                          PictureTolerance tolerance);

// The same with folders of the caller's choice, so that the workflow itself can be tested.
struct GoldenPlaces {
  std::string goldens;
  std::string failures;
  bool update = false;
};
::testing::AssertionResult matches_golden(const Image& actual, const std::string& name,
                                          PictureTolerance tolerance, const GoldenPlaces& places);

}  // namespace chainreel
