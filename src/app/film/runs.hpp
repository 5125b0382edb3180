// Station three of a film: what the panels of a prepared film do, from which its pictures, tables and audits are made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "draw/film/film.hpp"
#include "picture/text.hpp"
#include "scene/film_clock.hpp"
#include "sim/audit.hpp"

namespace chainreel {

// Which instant each frame shows. Slow motion that a scene asks for follows the events of the first panel; where the film
// has it by itself, the runs of all panels are looked at. They are computed for that. Throws Error (exit 7) where the
// film would be too long, (bad input) where it would be empty.
FilmClock clock_of(const PreparedFilm& film);

// 0, 1/fps, 2/fps, .. and the end of the motion, however slow its film is.
std::vector<double> plain_times(const PreparedFilm& film);

// A trajectory a panel, sampled at the same instants; the film must outlive them. Runs that fail are kept as far as they
// came. The constructors throw what clock_of throws, and the signal's Error.
class Runs {
 public:
  // At its frames and at the end of its motion. Where slow motion that a film has by itself is left out, these are the frames
  // that it would have without.
  enum class OwnSlowMotion { shown, left_out };
  explicit Runs(const PreparedFilm& film, OwnSlowMotion own = OwnSlowMotion::shown);
  Runs(const PreparedFilm& film, FilmClock clock, std::vector<double> times);

  const PreparedFilm& film() const { return film_; }
  bool leaves_slow_motion_out() const { return leaves_slow_motion_out_; }
  const FilmClock& clock() const { return clock_; }
  const std::vector<double>& times() const { return times_; }
  const std::vector<Trajectory>& list() const { return list_; }
  std::size_t size() const { return list_.size(); }
  const Trajectory& operator[](std::size_t panel) const { return list_[panel]; }

  // How many of that many instants a film shows: it ends with the last of its runs. One that is to diverge is shown
  // to stand still behind its end.
  int frames_shown(int frames) const;

  // Throws Error (exit 5, or the signal's) where a panel did not come to the end that its scene expects; for a picture of
  // one frame, of those alone that cannot show it or must diverge.
  void require_expected_ends(std::optional<int> frame = {}) const;

  // Station four: the pictures of the first `frames` instants.
  Film pictures(int frames, const Fonts& fonts) const;
  // Only where what they show stands on `page`, which is the film's but for its size.
  Composition composition(const Scene& page, int frames, const Fonts& fonts) const;

 private:
  std::vector<PanelRun> panels() const;
  void run_references() const;
  void find_change_points() const;

  const PreparedFilm& film_;
  FilmClock clock_;
  bool leaves_slow_motion_out_ = false;  // some that there would be
  std::vector<double> times_;
  std::vector<Trajectory> list_;
  mutable std::vector<Trajectory> references_;  // of the film, as soon as a picture is asked for
  mutable std::vector<std::vector<double>> change_points_;  // of each panel, s; likewise
};

// The events of each panel.
std::vector<RunEvents> events_of(const Runs& runs);

// The same for one run: it finished or was stopped by a limit, or diverged.
void require_expected_end(const Trajectory& trajectory, const Scene& scene);

// The limits that it passed though its scene expects it to stay within; an effort that `limit: clamp` keeps is none.
std::vector<LimitEvent> unexpected_limits(const Trajectory& trajectory, const Scene& scene);

// What is said while a panel runs.
std::string simulating_text(const PreparedFilm& film, const PreparedScene& panel);

// "panel 2 (rk4): message"
std::string in_panel(const Scene& scene, const Trajectory& trajectory, std::size_t i, const std::string& message);

}  // namespace chainreel
