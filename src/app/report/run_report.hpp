// What was run, and whether it can be trusted: of one run and of a film. Audits (JSON), alternative texts, captions and
// warnings are made of these.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "core/frame_rate.hpp"
#include "core/json.hpp"
#include "encode/library_versions.hpp"
#include "sim/audit.hpp"
#include "sim/doubts.hpp"

namespace chainreel {

// What it refers to must outlive it.
struct RunReport {
  const PreparedScene& prepared;
  const Trajectory& trajectory;
  Audit audit;
  std::vector<Doubt> warnings;             // none of a run that is to diverge
  std::optional<double> left_picture_at;  // s
  mutable std::optional<Json> constraint_facts{};

  // `constraint_run_report` of a run that has constraints, which takes runs of its own: worked out when it is first asked for.
  const Json& constraints() const;
};
RunReport run_report(const PreparedScene& prepared, const Trajectory& trajectory);
std::string title_of(const RunReport& run);  // the scene's, with what it leaves open: when it falls
Json to_json(const RunReport& report);

// A stretch of slow motion with its reason, if the film has it by itself; "t = 1 s to 1.5 s at 0.25x ('touch')".
Json to_json(const Stretch& one);
std::string to_words(const Stretch& one);

// What the camera sees, which is fitted to the motion unless the scene says otherwise.
struct ViewReport {
  double height = 0;  // of the page, m where the camera looks at
  Point origin;       // of the world on the page, from its lower left, units of its height
};

// What of a run's model its motion and pictures come from, as `describe_model` has it, without shapes that are not drawn. Meshes
// have a hash of their own.
Json mechanism_record(const PreparedScene& prepared);

struct FilmReport {
  const Runs& runs;
  std::vector<RunReport> panels;
  int frames = 0;  // of the whole film, with those that are held
  FilmClock clock;
  std::vector<Stretch> slow_motion;  // as far as the motion went
  std::vector<Pause> pauses;         // ... in the order of `annotate:`
  Writes writes = Writes::films;     // a single picture of it, or all
  std::vector<std::string> left_out = {};  // layers that a page this small has no room for
  double held_text_scale = 0;              // that its words have, where those asked for have no room; 0: as asked
  ViewReport view = {};                    // of the first panel

  const PreparedFilm& film() const { return runs.film(); }
  double film_seconds() const { return frame_time(frames, film().scene.video.fps); }
};
// `pictures` may be of one instant.
FilmReport film_report(const Runs& runs, const Film& pictures, int frames);
// The same from one run of the program to the next.
Json to_json(const FilmReport& report);

// What speaks against runs, a line each.
std::vector<std::string> warning_lines(const std::string& name, const RunReport& report);
std::vector<std::string> warning_lines(const FilmReport& report);
// The limits that joints passed, as they stand in reports.
Json to_json(const std::vector<LimitEvent>& limits);

// On standard error. Said even where all is to be quiet.
void tell_warnings(const std::vector<std::string>& lines);
// Of what is computed along a run of which no report is made: tells where its constraints come to depend on each other until `end`, s, unless the scene
// acknowledges that. One run by the method that the simulation has.
void warn_of_rank(const PreparedScene& prepared, double end);
// Likewise all that speaks against it, but for what the scene acknowledges and what only samples miss; of one that was
// looked at with its energy at steps, or of one more.
void warn_of_run(const PreparedScene& prepared, const Trajectory& trajectory);
void warn_of_run(const PreparedScene& prepared);

// Layers that the scene draws and the page is too small for, and the text_scale that it has no room for, a line each.
std::vector<std::string> left_out_words(const std::vector<std::string>& layers, double held_text_scale, const Scene& page);
// The same on standard error.
void tell_left_out(const std::vector<std::string>& layers, double held_text_scale, const Scene& page, bool quiet);

// What a run met with that one may not see in it, half a sentence each: limits that were passed, unless their passing ended it, and
// what ended it before its time, unless that is a failure. The same of films and of tables.
std::vector<std::string> notes_of(const PreparedScene& prepared, const Trajectory& trajectory);
// "passes its limit of effort", or that the torque is cut there.
std::string limit_words(const LimitEvent& limit, LimitPolicy policy);
// In a sentence with its numbers, and what comes of it.
std::string limit_note(const LimitEvent& limit, LimitPolicy policy);

// For how long the first frame is held: whole frames, s.
double held_first(const Scene& scene);

}  // namespace chainreel
