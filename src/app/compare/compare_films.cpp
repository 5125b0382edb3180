// Two films, frame by frame.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "app/cli/streams.hpp"
#include "app/compare/comparison.hpp"
#include "app/film/progress.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "core/machine.hpp"
#include "core/output_file.hpp"
#include "core/parallel.hpp"
#include "encode/film_reader.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

constexpr double kSameTime = 1e-3;  // s: WebM counts in thousandths

// A frame that is told of, and the pictures that it is in both films.
struct ToldFrame {
  int index = 0;
  ImageDifference difference;
  Image before, after;
};

struct FilmDifference {
  int frames[2] = {0, 0};
  double fps[2], seconds[2];
  int unequal = 0, beyond = 0;  // frames
  std::optional<ToldFrame> first, worst;
  std::optional<int> other_time;  // the first frame that is shown at another time
  double times[2];                // of that frame, s
  std::vector<double> errors;     // the worst of each frame that both have; 1 where sizes differ
  std::vector<double> means;      // over each whole frame
  std::vector<bool> failed;       // and whether it is beyond the tolerance
};

bool is_worse(const ImageDifference& a, const ImageDifference& b) {
  if (a.same_size != b.same_size) return !a.same_size;
  return a.beyond != b.beyond ? a.beyond > b.beyond : a.worst > b.worst;
}

FilmReader open(const std::string& path) {
  require_plain_file(path, kLargestInput * 64);
  note_input(path);
  return FilmReader(path);
}

// A frame of each film, and when it is shown, s.
struct FramePair {
  Image images[2];
  double times[2] = {0, 0};
  ImageDifference difference;
};

// What is known of the films so far; pairs come in the order of the frames.
void add_pair(FramePair& pair, const CompareOptions& options, FilmDifference& found) {
  const int index = int(found.errors.size());
  if (!found.other_time && std::abs(pair.times[0] - pair.times[1]) > kSameTime) {
    found.other_time = index;
    std::copy_n(pair.times, 2, found.times);
  }
  const ImageDifference& difference = pair.difference;
  const bool fails = !difference.passes(options.tolerance);
  found.errors.push_back(difference.same_size ? difference.worst : 1);
  found.means.push_back(difference.same_size ? difference.mean : 1);
  found.failed.push_back(fails);
  if (difference.is_equal()) return;
  ++found.unequal;
  if (fails) ++found.beyond;
  const bool is_worst = !found.worst || is_worse(difference, found.worst->difference);
  if (found.first && !is_worst) return;
  const ToldFrame frame{index, difference, pair.images[0], pair.images[1]};
  if (!found.first) found.first = frame;
  if (is_worst) found.worst = frame;
}

// Frames are decoded one after the other and compared by all threads.
void compare_frames(FilmReader* readers, const CompareOptions& options, FilmDifference& found) {
  const double expected = std::max(1.0, std::max(found.seconds[0] * found.fps[0], found.seconds[1] * found.fps[1]));
  WorkTicker ticker("comparing frames", options.common.quiet);
  const int threads = usable_cores();
  std::vector<FramePair> pairs(2 * std::size_t(threads));
  for (bool is_more = true; is_more;) {
    std::size_t count = 0;
    while (is_more && count < pairs.size()) {
      throw_if_interrupted();
      ticker.tell(std::min(1.0, std::max(found.frames[0], found.frames[1]) / expected));
      FramePair& pair = pairs[count];
      bool there[2];
      for (int i = 0; i < 2; ++i) {
        if ((there[i] = readers[i].next(pair.images[i]))) ++found.frames[i];
        pair.times[i] = readers[i].time();
      }
      is_more = there[0] || there[1];
      if (there[0] && there[1]) ++count;  // the longer one is counted to its end
    }
    for_each_index(count, threads, [&](std::size_t k) { pairs[k].difference = compare_images(pairs[k].images[0], pairs[k].images[1], options.tolerance); });
    for (std::size_t k = 0; k < count; ++k) add_pair(pairs[k], options, found);
  }
}

// Of two files with the same bytes the frames of one are counted.
void count_frames(FilmReader& reader, const CompareOptions& options, FilmDifference& found) {
  const double expected = std::max(1.0, found.seconds[0] * found.fps[0]);
  WorkTicker ticker("counting frames", options.common.quiet);
  for (Image image; reader.next(image); ++found.frames[0]) {
    throw_if_interrupted();
    ticker.tell(std::min(1.0, found.frames[0] / expected));
    found.errors.push_back(0);
    found.means.push_back(0);
    found.failed.push_back(false);
  }
  found.frames[1] = found.frames[0];
}

FilmDifference difference_of(const CompareOptions& options) {
  FilmReader readers[2] = {open(options.before), open(options.after)};
  FilmDifference found;
  for (int i = 0; i < 2; ++i) {
    found.fps[i] = readers[i].fps();
    found.seconds[i] = readers[i].seconds();
  }
  if (std::filesystem::file_size(options.before) == std::filesystem::file_size(options.after) &&
      audited_file(options.before)["sha256"] == audited_file(options.after)["sha256"])
    count_frames(readers[0], options, found);
  else
    compare_frames(readers, options, found);
  for (int i = 0; i < 2; ++i)
    if (found.frames[i] == 0)
      throw Error(ExitCode::bad_input, "holds no frame that can be decoded",
                  {i == 0 ? options.before : options.after});
  return found;
}

// Mean errors over time, from left to right, on a scale of their own: single pixels are as far off in nearly every frame of two
// motions. Of films with more frames than columns each column is its worst.
Image strip_of(const FilmDifference& found) {
  constexpr int kWidest = 1600, kHeight = 80;
  const int count = int(found.errors.size()), wide = std::max(1, std::min(8, kWidest / count));
  const int columns = std::min(count, kWidest);
  Image strip(columns * wide, kHeight);
  const double largest = *std::max_element(found.means.begin(), found.means.end());
  const auto row_of = [&](double mean) { return kHeight - 1 - int(std::lround(mean / largest * (kHeight - 1))); };
  for (int column = 0; column < columns; ++column) {
    const std::size_t from = std::size_t(column) * found.errors.size() / std::size_t(columns);
    const std::size_t to = std::size_t(column + 1) * found.errors.size() / std::size_t(columns);
    double worst = 0;
    bool fails = false;
    for (std::size_t i = from; i < to; ++i) {
      worst = std::max(worst, found.means[i]);
      fails = fails || found.failed[i];
    }
    for (int y = 0; y < kHeight; ++y)
      for (int x = column * wide; x < (column + 1) * wide; ++x) {
        const bool bar = worst > 0 && y >= row_of(worst);
        const Pixel color = bar && fails ? Pixel{183, 55, 121} : bar ? Pixel{150, 200, 235} : Pixel{245, 245, 245};
        std::uint8_t* p =
            &strip.bgra[std::size_t(4) * (std::size_t(y) * std::size_t(strip.width) + std::size_t(x))];
        p[0] = color.b;
        p[1] = color.g;
        p[2] = color.r;
        p[3] = 255;
      }
  }
  return strip;
}

Json report_of(const ToldFrame& frame) {
  Json json = report_of(frame.difference, frame.before, frame.after);
  json["frame"] = frame.index;
  return json;
}

}  // namespace

Comparison compare_films(const CompareOptions& options) {
  const FilmDifference found = difference_of(options);
  Comparison result;
  const bool same_length = found.frames[0] == found.frames[1], same_rate = found.fps[0] == found.fps[1];
  const bool same_times = same_length && same_rate && !found.other_time;
  result.equal = found.unequal == 0 && same_times;
  result.passes = found.beyond == 0 && same_times;
  const int both = std::min(found.frames[0], found.frames[1]);
  if (!same_length)
    result.words.push_back("frames: " + std::to_string(found.frames[0]) + " -> " +
                           std::to_string(found.frames[1]));
  if (!same_rate)
    result.words.push_back("frames a second: " + format_significant(found.fps[0], 6) + " -> " +
                           format_significant(found.fps[1], 6));
  if (same_rate && found.other_time)
    result.words.push_back("frame " + std::to_string(*found.other_time) + " is shown at " +
                           format_significant(found.times[0], 6) + " s -> " +
                           format_significant(found.times[1], 6) + " s");
  if (found.unequal == 0) {
    result.words.push_back("all " + std::to_string(both) + " frames that both have are equal");
  } else {
    result.words.push_back(std::to_string(found.unequal) + " of " + std::to_string(both) +
                           " frames are unequal, " + std::to_string(found.beyond) + " beyond the tolerance");
    for (const auto& [name, frame] :
         {std::pair("the first", &*found.first), std::pair("the worst", &*found.worst)})
      result.words.push_back(std::string(name) + ", frame " + std::to_string(frame->index) + ": " +
                             told(frame->difference, frame->before, frame->after, options.tolerance));
  }
  result.report = {{"frames", {found.frames[0], found.frames[1]}},
                   {"fps", {found.fps[0], found.fps[1]}},
                   {"seconds", {found.seconds[0], found.seconds[1]}},
                   {"unequal_frames", found.unequal},
                   {"frames_beyond", found.beyond},
                   {"errors", found.errors},
                   {"mean_errors", found.means}};
  if (found.first)
    result.report.update({{"first", report_of(*found.first)}, {"worst", report_of(*found.worst)}});
  if (found.other_time)
    result.report["other_time"] = {{"frame", *found.other_time},
                                   {"seconds", {found.times[0], found.times[1]}}};
  const std::vector<std::string> remembered = explain_memories(options.before, options.after);
  result.words.insert(result.words.end(), remembered.begin(), remembered.end());
  result.report["explained"] = remembered;
  if (!options.output.empty()) {
    Image before, after;
    if (found.worst) {
      before = found.worst->before;
      after = found.worst->after;
    } else {
      open(options.before).next(before);
      open(options.after).next(after);
    }
    write_difference(options, before, after, options.output);
  }
  if (!options.strip.empty()) {
    OutputFile file(options.strip, options.common.force);
    write_png(file.temporary_path(), strip_of(found));
    file.commit();
  }
  return result;
}

}  // namespace chainreel
