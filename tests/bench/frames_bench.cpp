// What a frame costs before it is encoded: shapes made, pixels drawn and read, luma and chroma of what changed.
//
// Rule: the first ten seconds of each scene of assets/scenes (or of those that are named on the command line) are drawn
// frame after frame at the size of the scene, reported is the processor time a frame, the least of five
// rounds after a first one that compiles the shaders.
#include <ctime>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "encode/yuv.hpp"
#include "render/canvas.hpp"

namespace chainreel::bench {
namespace {

constexpr int kRounds = 5;
constexpr double kSeconds = 10;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct Planes {
  std::vector<std::uint8_t> y, cb, cr;
  PlanesYuv420 places;

  Planes(int width, int height)
      : y(std::size_t(width) * std::size_t(height)), cb(y.size() / 4), cr(y.size() / 4),
        places{{y.data(), cb.data(), cr.data()}, {width, width / 2, width / 2}} {}
};

struct Stages {
  double shapes = 0, pixels = 0, convert = 0, share = 0;
  double sum() const { return shapes + pixels + convert; }
};

Stages round_of(const Film& film, Canvas& canvas, Planes& planes, int frames) {
  Stages stages;
  canvas.set_static_layer(film.static_layer());
  for (int k = 0; k < frames; ++k) {
    const double start = cpu_seconds();
    const Picture picture = film.frame(k);
    const double drawn = cpu_seconds();
    const CanvasFrame& frame = canvas.draw(picture);
    const double read = cpu_seconds();
    for (const PixelBox& box : frame.changed) convert_to_yuv420(frame.image, box, planes.places);
    const double end = cpu_seconds();
    if (k == 0) continue;  // the whole page
    for (const PixelBox& box : frame.changed) stages.share += double(box.width) * box.height;
    stages.shapes += drawn - start;
    stages.pixels += read - drawn;
    stages.convert += end - read;
  }
  for (double* part : {&stages.shapes, &stages.pixels, &stages.convert, &stages.share}) *part /= frames - 1;
  return stages;
}

void run(const std::string& scene, int width, int height) {
  const PreparedFilm film = load_film(scene, {"video.width=" + std::to_string(width), "video.height=" + std::to_string(height)}, true, true);
  const Runs runs(film);
  const Fonts fonts;
  const int frames = std::min(runs.frames_shown(runs.clock().frame_count()), int(kSeconds * film.scene.video.fps.value()));
  const Film pictures = runs.pictures(runs.frames_shown(runs.clock().frame_count()), fonts);
  Canvas canvas(width, height, fonts);
  Planes planes(width, height);
  Stages best;
  for (int round = 0; round <= kRounds; ++round) {
    const Stages now = round_of(pictures, canvas, planes, frames);
    if (round == 1 || (round > 1 && now.sum() < best.sum())) best = now;
  }
  std::printf("%-20s %4d lines: shapes %.3f, pixels %.3f, convert %.3f, together %.3f ms a frame; %.1f %% of the page\n",
              film.scene.name.c_str(), height, 1e3 * best.shapes, 1e3 * best.pixels, 1e3 * best.convert,
              1e3 * best.sum(), 100 * best.share / width / height);
}

}  // namespace
}  // namespace chainreel::bench

int main(int count, char** words) {
  std::vector<std::string> scenes(words + 1, words + count);
  if (scenes.empty())
    for (const auto& entry : std::filesystem::directory_iterator("assets/scenes"))
      if (entry.path().extension() == ".yaml") scenes.push_back(entry.path().string());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& [width, height] : {std::array{1280, 720}, std::array{1920, 1080}})
    for (const std::string& scene : scenes) chainreel::bench::run(scene, width, height);
}
