// Words over a chain that belong to marks: arrows, arcs, axes, poses. They are drawn above all marks: in films where
// their plan has them (draw/page/word_plan), in figures moved apart where they would overlap, and left out where there
// is no room near what they name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "picture/picture.hpp"
#include "picture/text.hpp"

namespace chainreel {

inline constexpr double kWordHalo = 0.0035;  // about the letters, units of H

// A line from a word to what it speaks of.
struct Leader {
  Point to;
  Color color;
};

// A thin line from a word that stands farther than `near` from what it names, up to there, or to its other end if that is nearer.
struct Tie {
  Point to;
  double near = 0;
  Color color;
  std::optional<Point> other_end{};
  double shortest = 0.018;  // a shorter one is none
  bool dot = false;  // at its end, as of a leader
  double cost = 0;  // of each H of its length, a second, to a plan of films (draw/page/word_plan)
};

struct TieLine {
  Point from, to;
};
// The line of a word that stands there; nothing where it is near enough.
std::optional<TieLine> line_of(const Tie& tie, const Rect& box);
std::optional<TieLine> line_of(const Leader& leader, const Rect& box);

struct MarkWord {
  std::string name;  // the same from frame to frame; words of one name are told apart by where they are
  TextLine line;
  std::vector<Rect> places;  // of its ink, units of H, the best first; at least one
  std::optional<Leader> leader = std::nullopt;  // its word was asked for: it stands on others rather than nowhere
  std::optional<Tie> tie = std::nullopt;
  std::vector<TextLine> other_shapes{};  // the same words on more lines: for the places of their size
  std::vector<bool> closed{};            // of the places: not to be had at this frame, but they keep their numbers; empty: none
  std::optional<Point> anchor{};         // what it rides along with, as an arrow's tip; none: its mark does not move

  // What stands in such a box.
  const TextLine& shape_for(const Rect& box) const;
};

// Places of a line's ink about a point, `off` away from it: eight directions, `first` of them, the next ones beside it,
// the opposite one last.
std::vector<Rect> places_about(const TextLine& line, Point middle, double off, Point first);
// The ink of a line that stands off `near` by `gap` along the unit vector `direction`.
Rect place_beyond(const TextLine& line, Point near, double gap, Point direction);

// The same box, moved the shortest way into the area.
Rect moved_into(const Rect& area, const Rect& r);

// Where a word stands at a frame.
struct StandingWord {
  Rect box;
  double opacity = 1;  // 0: it is left out
  std::optional<Point> anchor{};  // as of its MarkWord
};

// The same in few bytes, since long films have many frames.
struct ChosenPlace {
  std::int16_t place = kNowhere;  // of its MarkWord, moved into the area
  float opacity = 0;

  static constexpr int kNowhere = -1;
};
StandingWord standing_at(const MarkWord& word, const ChosenPlace& chosen, const Rect& area);

class MarkLabels {
 public:
  MarkLabels() = default;
  // Where the words stand, in the order in which they will be added.
  explicit MarkLabels(std::span<const StandingWord> plan) : plan_(plan) {}
  MarkLabels(std::span<const ChosenPlace> chosen, const Rect& area) : chosen_(chosen), area_(area) {}

  void add(MarkWord word);
  // `box`: where the ink of the line is wished; places around it will do.
  void add(const std::string& name, TextLine line, const Rect& box, std::optional<Point> anchor = {});
  // Of the words from that one on: a place that is nearer to what another of them names would be read as that one's.
  void close_nearer_to_others(std::size_t from);
  const std::vector<MarkWord>& words() const& { return words_; }
  std::vector<MarkWord> words() && { return std::move(words_); }

  // With a halo of the background's colour. Without a plan inside `area`: labels that are wished outside of it are left
  // out, and those that would have to go farther than `farthest` heights of their own.
  void draw(Picture& picture, const Rect& area, Color background, int clip, double farthest = 1.5) const;

 private:
  std::span<const StandingWord> plan_;
  std::span<const ChosenPlace> chosen_;
  Rect area_{};  // of these
  std::vector<MarkWord> words_;
};

// Boxes moved apart, as little as need be, within `area`: the places of those that can stand, and nothing for
// those left out. The same for the same boxes, whatever was drawn before.
struct PlacedBox {
  Rect box;
  bool stands = true;
};
std::vector<PlacedBox> boxes_apart(const std::vector<Rect>& wishes, const Rect& area, double air,
                                   double farthest);

}  // namespace chainreel
