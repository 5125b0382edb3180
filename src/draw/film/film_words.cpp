#include "draw/film/film_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "draw/layers/body_obstacles.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

// What layers draw, by what it means to words.
struct Pictures {
  std::array<Picture, 3> by_layer;

  Picture& of(const Layer& layer) { return by_layer[std::size_t(layer.under_words())]; }
  void add_to(std::vector<Obstacle>& obstacles) const {
    for (const UnderWords under : {UnderWords::never, UnderWords::if_need_be})
      for (const Obstacle& obstacle : obstacles_of(by_layer[std::size_t(under)], under == UnderWords::if_need_be))
        obstacles.push_back(obstacle);
  }
};

class Gatherer {
 public:
  Gatherer(const Layers& layers, const FilmView& view, const std::vector<Panel>& panels)
      : layers_(layers), view_(view), panels_(panels) {}

  // What stands in the way of words at a frame of a panel, and its words.
  void draw(std::size_t i, int k, std::vector<Obstacle>& obstacles, MarkLabels& labels, bool is_still = false) const {
    const Panel& panel = panels_[i];
    const int shown = std::clamp(k, 0, panel.last());
    const Workspace& ws = panel.motion().pose_at(shown);
    Pictures pictures;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
      const Layer& layer = *layers_[l];
      if (!layer.is_of(panel.motion()) || (layer.under_words() == UnderWords::freely && !layer.has_words())) continue;
      layer.draw(pictures.of(layer), {panel, ws, shown, k > shown, view_.corner(l, i), labels, is_still});
    }
    pictures.add_to(obstacles);
    if (!panel.motion().shapes()) return;
    add_bodies(obstacles, panel.motion().skeleton(), ws, panel.camera());
    add_silhouettes(obstacles, *panel.motion().shapes(), ws, panel.camera(), true);
  }

  // The same; chains in outline lie over the first one.
  MarkLabels gather(std::size_t i, int k, const Stage& stage, std::vector<Obstacle>& obstacles, bool is_still = false) const {
    MarkLabels labels, others;
    draw(i, k, obstacles, labels, is_still);
    if (stage.is_ghost())
      for (std::size_t j = 1; j < panels_.size(); ++j) draw(j, k, obstacles, others);
    return labels;
  }

  std::vector<Obstacle> once(std::size_t i, const SharedPage& page) const {
    Pictures pictures;
    for (const auto& layer : layers_) {
      if (layer->under_words() == UnderWords::freely) continue;
      if (layer->is_of(panels_[i].motion())) layer->draw_once(pictures.of(*layer), panels_[i]);
      layer->draw_page_once(pictures.of(*layer), page);
    }
    std::vector<Obstacle> obstacles;
    pictures.add_to(obstacles);
    return obstacles;
  }

 private:
  const Layers& layers_;
  const FilmView& view_;
  const std::vector<Panel>& panels_;
};

// The ink of a word, and the line of one that was asked for, as obstacles to others.
void add_obstacles(const StandingWord& word, const MarkWord& of, std::vector<Obstacle>& obstacles) {
  constexpr double kRow = 0.025;  // units of H: of words on several lines one capsule would leave the corners
  const Rect& box = word.box;
  const int rows = std::max(1, int(std::lround(box.height() / kRow)));
  const double radius = std::min(box.width(), box.height() / rows) / 2;
  for (int row = 0; row < rows; ++row) {
    const double y = box.y0 + (row + 0.5) * box.height() / rows;
    obstacles.push_back({{box.x0 + radius, y}, {box.x1 - radius, y}, radius + kBetweenWords});
  }
  const std::optional<TieLine> line = of.leader ? line_of(*of.leader, box) : std::nullopt;
  if (line) obstacles.push_back({line->from, line->to, kBetweenWords});
}

// Plans words on a thread of its own, some frames at a time, while the next ones are drawn.
class Planner {
 public:
  explicit Planner(WordPlan& plan) : plan_(plan) {}

  void add(std::vector<MarkWord> words, std::vector<Obstacle> obstacles) {
    drawn_.push_back({std::move(words), std::move(obstacles)});
    if (drawn_.size() == kFramesAtOnce) hand_over();
  }
  void finish() {
    hand_over();
    at_work_.get();
  }

 private:
  static constexpr std::size_t kFramesAtOnce = 32;  // far longer than a thread takes to begin
  struct Drawn {
    std::vector<MarkWord> words;
    std::vector<Obstacle> obstacles;
  };

  void hand_over() {
    if (at_work_.valid()) at_work_.get();
    // Where there is no thread to be had the frames are planned when the next ones are handed over.
    at_work_ = std::async(std::launch::async | std::launch::deferred, [this, frames = std::exchange(drawn_, {})] {
      for (const Drawn& frame : frames) plan_.add(frame.words, frame.obstacles);
    });
  }

  WordPlan& plan_;
  std::vector<Drawn> drawn_;
  std::future<void> at_work_;
};

constexpr double kAirInCell = 0.008;  // units of H: from its frame

// Where words may stand: a cell of a comparison has a frame, which is to strike none.
Rect area_of_words(const Stage& stage, const Panel& panel) {
  return stage.has_cells() ? widened(panel.area(), -kAirInCell) : panel.area();
}

}  // namespace

FilmWords::FilmWords(const Stage& stage, const Layers& layers, const FilmSheet& sheet, const FilmView& view,
                     const std::vector<Panel>& panels) {
  if (std::none_of(layers.begin(), layers.end(), [](const auto& layer) { return layer->has_words(); })) return;
  const Gatherer gatherer(layers, view, panels);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Rect area = area_of_words(stage, panels[i]);
    WordPlan plan(area, stage.page.video.fps.value());
    const std::vector<Obstacle> always = gatherer.once(i, view.shared_page(stage, sheet));
    Planner planner(plan);
    for (int k = 0; k <= panels[i].last() && !panels[i].motion().is_outlined(); ++k) {
      std::vector<Obstacle> obstacles = always;
      MarkLabels labels = gatherer.gather(i, k, stage, obstacles);
      planner.add(std::move(labels).words(), std::move(obstacles));
    }
    planner.finish();
    panels_.push_back({area, plan.planned()});
  }
}

MarkLabels FilmWords::labels(std::size_t panel, int frame) const {
  if (panels_.empty() || panels_[panel].words.empty()) return {};
  return MarkLabels(panels_[panel].words.at(frame), panels_[panel].area);
}

namespace {

// Which of a film's words each word of a still is: of its name the nearest. A still has words that the film leaves out where
// they would run, and those the film does not know.
std::vector<std::optional<std::size_t>> found_among(const std::vector<MarkWord>& of_film, const std::vector<MarkWord>& of_still) {
  std::vector<std::optional<std::size_t>> found(of_still.size());
  std::vector<bool> is_taken(of_film.size(), false);
  for (std::size_t i = 0; i < of_still.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < of_film.size(); ++j) {
      const double way = norm(center_of(of_film[j].places.front()) - center_of(of_still[i].places.front()));
      if (is_taken[j] || of_film[j].name != of_still[i].name || of_film[j].places.size() != of_still[i].places.size() || !(way < least)) continue;
      least = way, found[i] = j;
    }
    if (found[i]) is_taken[*found[i]] = true;
  }
  return found;
}

}  // namespace

std::vector<StandingWord> FilmWords::standing(const Stage& stage, const Layers& layers, const FilmView& view, const std::vector<Panel>& panels,
                                              std::size_t panel, int frame) const {
  if (panels_.empty() || panels_[panel].words.empty()) return {};
  std::vector<Obstacle> unused;
  const MarkLabels labels = Gatherer(layers, view, panels).gather(panel, frame, stage, unused);
  const std::span<const ChosenPlace> chosen = panels_[panel].words.at(frame);
  std::vector<StandingWord> standing;
  for (std::size_t i = 0; i < chosen.size(); ++i) standing.push_back(standing_at(labels.words()[i], chosen[i], panels_[panel].area));
  return standing;
}

std::vector<StandingWord> FilmWords::still(const Stage& stage, const Layers& layers, const FilmSheet& sheet, const FilmView& view,
                                           const std::vector<Panel>& panels, std::size_t panel, int frame) const {
  if (panels_.empty() || panels_[panel].words.empty()) return {};
  const Gatherer gatherer(layers, view, panels);
  std::vector<Obstacle> obstacles = gatherer.once(panel, view.shared_page(stage, sheet));
  std::vector<MarkWord> wishes = gatherer.gather(panel, frame, stage, obstacles, true).words();
  std::vector<Obstacle> unused;
  const std::vector<MarkWord> of_film = gatherer.gather(panel, frame, stage, unused).words();
  const Rect& area = panels_[panel].area;
  const std::span<const ChosenPlace> chosen = panels_[panel].words.at(frame);
  const std::vector<std::optional<std::size_t>> same = found_among(of_film, wishes);
  std::vector<StandingWord> words;
  for (std::size_t i = 0; i < wishes.size(); ++i) words.push_back(standing_at(wishes[i], same[i] ? chosen[*same[i]] : ChosenPlace{}, area));
  // A number that is told otherwise than in the film has other boxes at its places, which may lie on what the film's keep off.
  const auto is_told_otherwise = [&](std::size_t i) {
    return same[i] && std::abs(words[i].box.width() - standing_at(of_film[*same[i]], chosen[*same[i]], area).box.width()) > kRoundOff;
  };
  const auto lies_on_word = [&](std::size_t i) {
    for (std::size_t j = 0; j < words.size(); ++j)
      if (j != i && words[j].opacity > 0 && overlap(widened(words[i].box, kBetweenWords), words[j].box)) return true;
    return false;
  };
  for (std::size_t i = 0; i < words.size(); ++i)
    if (is_told_otherwise(i) && !wishes[i].leader && (lies_on(words[i].box, obstacles, true) || lies_on_word(i))) words[i].opacity = 0;
  const auto is_left_out = [](const StandingWord& word) { return !(word.opacity > 0); };
  const bool has_left_out = std::any_of(words.begin(), words.end(), is_left_out);
  for (StandingWord& word : words) word.opacity = is_left_out(word) ? 0 : 1;
  if (!has_left_out) return words;
  std::vector<MarkWord> missing;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_left_out(words[i]))
      missing.push_back(std::move(wishes[i]));
    else
      add_obstacles(words[i], wishes[i], obstacles);
  }
  WordPlan plan(area, kLooksPerSecond);
  plan.add(missing, obstacles);
  const std::vector<StandingWord> found = plan.standing().front();
  auto next = found.begin();
  for (StandingWord& word : words)
    if (is_left_out(word)) word = *next++;
  return words;
}

}  // namespace chainreel
