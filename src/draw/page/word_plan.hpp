// Where the words of marks stand over a whole film. Each word has several places at each frame; it keeps off what is
// drawn and off other words, stays at one of its places as long as that is free, and fades where it goes to another one
// or where it would run faster than can be read. What rides along with its mark does not run: it stays where it is about that.
// It is decided over all frames at once, so that any frame can be drawn alone.
#pragma once

#include <cstdint>
#include <map>
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

// From one frame to the next no word moves farther, units of H, but where it fades: on the page, or about its anchor while that
// moves no farther than an eye can follow.
inline constexpr double kWordStep = 0.02, kAnchorStep = 0.1;
bool moves_on(const StandingWord& before, const StandingWord& now);
// A word that is there for less cannot be read: a glance takes a quarter of a second. The first and the last frame of a film stand longer.
inline constexpr double kShortestStay = 0.3;  // s
// The rate of frames of a picture by itself, which is looked at for so long that any word is worth its place.
inline constexpr double kLooksPerSecond = 0.1;
inline constexpr double kBetweenWords = 0.006;
// Between a word and what it keeps off.
inline constexpr double kWordAir = 0.004;

class WordPlan {
 public:
  enum class Ground : std::uint8_t { free, poor, taken };  // what lies at a place

  WordPlan(const Rect& area, double fps, double between = kBetweenWords) : area_(area), fps_(fps), between_(between) {}

  // The next frame.
  void add(const std::vector<MarkWord>& words, const std::vector<Obstacle>& obstacles);
  // By frame, in the order of the words.
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

    std::optional<TieLine> line_at(int place) const { return tie ? line_of(*tie, places[std::size_t(place)]) : std::nullopt; }
    StandingWord at(int place, double opacity = 1) const { return {places[std::size_t(place)], opacity, anchor}; }
  };
  // One word from frame to frame.
  using Track = std::vector<Moment>;

  Track& track_of(const MarkWord& word, int frame);

  Rect area_;
  double fps_, between_;
  std::vector<int> counts_;  // words of each frame
  std::vector<Track> tracks_;
  std::map<std::string, std::vector<std::size_t>> by_name_;
};

}  // namespace chainreel
