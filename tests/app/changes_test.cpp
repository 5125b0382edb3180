// A canvas draws what changed from frame to frame: every film has the bytes that it has when each frame is drawn whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "app/print_pictures.hpp"
#include "render/canvas.hpp"

namespace chainreel {
namespace {

constexpr int kChangesWidth = 480, kChangesHeight = 270;

// Neighbours at the beginning, in the middle and at the end, and leaps forth and back.
std::vector<int> frames_of(const Film& film) {
  std::vector<int> frames;
  const int last = film.frame_count() - 1;
  for (const int k : {0, 1, 2, last / 2, last / 2 + 1, last / 2 + 3, last - 1, last, 5, 5})
    frames.push_back(std::clamp(k, 0, last));
  return frames;
}

// Whether they hold every pixel that differs.
bool hold_all_changes(const std::vector<PixelBox>& boxes, const Image& before, const Image& now) {
  for (int y = 0; y < now.height; ++y)
    for (int x = 0; x < now.width; ++x)
      if (before.at(x, y) != now.at(x, y) && std::none_of(boxes.begin(), boxes.end(), [&](const PixelBox& box) {
            return x >= box.x && x < box.right() && y >= box.y && y < box.bottom();
          }))
        return false;
  return true;
}

std::string first_difference(const Image& a, const Image& b) {
  int count = 0, largest = 0;
  std::string first;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (a.at(x, y) == b.at(x, y)) continue;
      if (count++ == 0) first = std::to_string(x) + ", " + std::to_string(y);
      const Pixel p = a.at(x, y), q = b.at(x, y);
      largest = std::max({largest, std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b), std::abs(p.a - q.a)});
    }
  if (count == 0) return "";
  return std::to_string(count) + " pixels differ by up to " + std::to_string(largest) + ", the first at " + first;
}

class Changes : public ::testing::TestWithParam<test::AnyPicture> {};

std::vector<test::AnyPicture> films() {
  std::vector<test::AnyPicture> list = test::all_pictures();
  std::erase_if(list, [](const test::AnyPicture& picture) { return !picture.show_film; });
  return list;
}

INSTANTIATE_TEST_SUITE_P(Of, Changes, ::testing::ValuesIn(films()), [](const auto& p) { return p.param.name; });

TEST_P(Changes, MakeTheBytesOfTheWholePage) {
  static const Fonts fonts;
  for (const char* theme : {"light", "dark"})
    GetParam().show_film({theme, kChangesWidth, kChangesHeight, 1.5}, fonts, [&](const Film& film) {
      Canvas canvas(kChangesWidth, kChangesHeight, fonts), whole(kChangesWidth, kChangesHeight, fonts);
      canvas.set_static_layer(film.static_layer());
      Image before;
      double share = 0;
      for (const int k : frames_of(film)) {
        const Picture picture = film.frame(k);
        whole.set_static_layer(film.static_layer());  // forgets what the page shows
        const CanvasFrame &expected = whole.draw(picture), &frame = canvas.draw(picture);
        ASSERT_EQ(first_difference(frame.image, expected.image), "") << theme << ", frame " << k;
        if (before.width > 0) ASSERT_TRUE(hold_all_changes(frame.changed, before, frame.image)) << theme << ", frame " << k;
        before = frame.image;
        share = 0;
        for (const PixelBox& box : frame.changed) share += double(box.width) * box.height / (kChangesWidth * kChangesHeight);
      }
      EXPECT_EQ(share, 0) << "the last frame is the one before, once more";
      // A picture by itself is drawn without OpenGL, which has drawn what lies under the frames.
      Canvas still(kChangesWidth, kChangesHeight, fonts, PageUse::still);
      Picture all = film.static_layer();
      all.append(film.frame(frames_of(film).back()));
      ASSERT_EQ(first_difference(still.draw(all).image, before), "") << theme;
    });
}

// Negative control: a film whose frames are all told apart from nothing would pass above, too.
TEST(ChangesOfFrames, AreLessThanThePage) {
  static const Fonts fonts;
  for (const test::AnyPicture& picture : test::all_pictures()) {
    if (picture.name != "rr_torque" && picture.name != "rr_ellipse") continue;
    picture.show_film({"light", 1920, 1080, 1}, fonts, [&](const Film& film) {
      Canvas canvas(1920, 1080, fonts);
      canvas.set_static_layer(film.static_layer());
      double share = 0;
      for (int k = 0; k < 30; ++k)
        for (const PixelBox& box : canvas.draw(film.frame(k)).changed)
          if (k > 0) share += double(box.width) * box.height / (29.0 * 1920 * 1080);
      EXPECT_LT(share, 0.15) << picture.name;  // about 0.06, and 0.1 where an ellipse swings
      EXPECT_GT(share, 0.005) << picture.name;
    });
  }
}

}  // namespace
}  // namespace chainreel
