// Where the words of marks stand over a whole film. Each word has several places at each frame; it keeps off what is
// drawn and off other words, stays at one of its places as long as that is free, and fades where it goes to another one
// or where it would run faster than can be read. What rides along with its mark does not run: it stays where it is about that.
// It is decided over all frames at once, so that any frame can be drawn alone.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/page/mark_labels.hpp"

namespace chainreel {

// All points within `radius` of a-b: what words must not lie on.
struct Obstacle {
  Point a, b;
  double radius = 0;
  bool may_yield = false;  // a word rather stands on it than nowhere
};

// Lines, discs, edges and letters of what is drawn, units of H; what is too pale to disturb, halos and bodies in space are none.
std::vector<Obstacle> obstacles_of(const Picture& picture, bool may_yield = false);
// Whether words in such a box lie on one of them that does not yield, or on any.
bool lies_on(const Rect& box, const std::vector<Obstacle>& obstacles, bool on_what_yields = false);

// From one frame to the next no word moves farther, units of H, but where it fades: on the page, or about its anchor while that
// moves no farther than an eye can follow.
inline constexpr double kWordStep = 0.02, kAnchorStep = 0.1;
bool moves_on(const StandingWord& before, const StandingWord& now);
// A word that is there for less cannot be read: a glance takes a quarter of a second. The first and the last frame of a film stand longer.
inline constexpr double kShortestStay = 0.3, kFadeSeconds = 0.12;  // s; the fade is of its beginning and its end
// The rate of frames of a picture by itself, which is looked at for so long that any word is worth its place.
inline constexpr double kLooksPerSecond = 0.1;
inline constexpr double kBetweenWords = 0.006;
// Between a word and what it keeps off.
inline constexpr double kWordAir = 0.004;

// What is decided of a film's words, by frame, in the order of the words of each.
class PlannedWords {
 public:
  void add_frame(std::span<const ChosenPlace> words) {
    if (words_.empty() && !words.empty()) ends_.assign(frames_, 0);
    ++frames_;
    words_.insert(words_.end(), words.begin(), words.end());
    if (!words_.empty()) ends_.push_back(std::uint32_t(words_.size()));
  }
  std::span<const ChosenPlace> at(int frame) const {
    if (ends_.empty()) return {};
    const std::size_t begin = frame > 0 ? ends_[std::size_t(frame) - 1] : 0;
    return std::span(words_).subspan(begin, ends_[std::size_t(frame)] - begin);
  }
  bool empty() const { return frames_ == 0; }

 private:
  std::size_t frames_ = 0;
  std::vector<ChosenPlace> words_;
  std::vector<std::uint32_t> ends_;  // of the words of each frame; none where no frame has any
};

class WordPlan {
 public:
  enum class Ground : std::uint8_t { free, poor, taken };  // what lies at a place

  WordPlan(const Rect& area, double fps, double between = kBetweenWords) : area_(area), fps_(fps), between_(between) {}

  // The next frame. A long film is planned by stretches, each with a look at what comes, so that only these are kept in memory.
  void add(const std::vector<MarkWord>& words, const std::vector<Obstacle>& obstacles);
  PlannedWords planned() const;
  // The same as boxes: of one stretch at most, from its first frame on.
  std::vector<std::vector<StandingWord>> standing() const;

 private:
  struct Moment {
    int frame = 0, index = 0;      // of the word among those of the frame
    std::vector<Rect> places;      // moved into the area
    std::vector<Ground> grounds;
    bool insists = false;         // rather on anything than nowhere
    std::vector<double> leaders;  // of words with a line: what that from each place costs
    std::optional<Point> anchor;
    std::optional<Tie> tie;
    std::optional<int> fixed{};  // the place that was decided upon, or kNowhere
    std::optional<Leader> leader{};  // of words that insist

    std::optional<TieLine> line_at(int place) const {
      const Rect& box = places[std::size_t(place)];
      return leader ? line_of(*leader, box) : tie ? line_of(*tie, box) : std::nullopt;
    }
    StandingWord at(int place, double opacity = 1) const { return {places[std::size_t(place)], opacity, anchor}; }
  };
  // One word from frame to frame.
  struct Track {
    std::vector<Moment> moments;
    int last_frame = -1;
    Point last_wish{};  // the middle of its best place there
  };
  struct Placed;  // a word that has its place
  using Decisions = std::vector<std::vector<Placed>>;  // by frame from first_ on

  Track& track_of(const MarkWord& word, int frame);
  std::vector<const Track*> in_order() const;
  int frames() const { return first_ + int(counts_.size()); }
  int frames_in(double seconds) const;
  Decisions decide(bool is_whole) const;
  void add_frames(const Decisions& placed, int end, PlannedWords& planned) const;
  void settle(int end);

  Rect area_;
  double fps_, between_;
  int first_ = 0;            // frame of which the moments are kept
  int settled_ = 0;          // frames that are decided, for good
  std::vector<int> counts_;  // words of each frame from first_ on
  std::vector<Track> tracks_;
  std::map<std::string, std::vector<std::size_t>> by_name_;
  PlannedWords planned_;  // settled frames
};

}  // namespace chainreel
