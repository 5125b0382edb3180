#include "app/works/render_film.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "app/film/automatic.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/driving_tables.hpp"
#include "app/report/report.hpp"
#include "app/report/sidecar.hpp"
#include "app/report/motion_table.hpp"
#include "app/report/version.hpp"
#include "app/works/draw_film.hpp"
#include "app/works/moment.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/output_file.hpp"
#include "draw/page/house_style.hpp"
#include "encode/png.hpp"
#include "encode/small_frames.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

void write_tables(const Runs& runs, std::vector<Output>& outputs) {
  for (Output& output : outputs)
    if (output.shows(Shows::table))
      for (std::size_t i = 0; i < runs.size(); ++i)
        write_temporary(*output.files[i], table_bytes(motion_table(runs.film().panels[i].simulation, runs[i]),
                                                      table_format_of(output.target.path)));
}

// Limits that were passed and runs that were stopped: no failure, but not what one may think either.
void add_run_notes(const Runs& runs, std::vector<std::string>& notes) {
  const PreparedFilm& film = runs.film();
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const std::string& text : notes_of(film.panels[i], runs[i]))
      notes.push_back(film.scene.name + ": " + (runs.size() == 1 ? text : in_panel(film.panels[i].scene, runs[i], i, text)));
}

// Slow motion about an event that never comes is none, nor are its words, which their author may want to know.
void add_missing_events(const Runs& runs, std::vector<std::string>& notes) {
  const PreparedFilm& film = runs.film();
  const std::vector<EventEntry>& events = film.panels.front().scene.events;
  for (const SlowMotionEntry& entry : film.scene.slow_motion) {
    const auto is_its = [&](int event) { return events[std::size_t(event)].title() == entry.event; };
    const std::vector<int>& hits = runs[0].events.event;
    if (!entry.event.empty() && std::none_of(hits.begin(), hits.end(), is_its))
      notes.push_back(film.scene.name + ": no slow motion about '" + entry.event + "', which does not happen");
  }
  const std::vector<RunEvents> of_panels = events_of(runs);
  for (const AnnotationEntry& entry : film.scene.annotate)
    if (!instant_of(entry, of_panels))
      notes.push_back(film.scene.name + ": '" + entry.text + "' is not said, as '" + entry.event + "' does not happen");
}

// Slow motion that nobody asked for, and how to be without it; or that there is none by the scene's own numbers.
void add_own_slow_motion(const FilmReport& report, std::vector<std::string>& notes) {
  const Scene& scene = report.film().scene;
  if (!scene.slow_motion_rule) return;
  if (scene.slow_motion_rule->is_asked) {
    if (report.slow_motion.empty())
      notes.push_back(scene.name + ": no slow motion: nothing turns that fast and no event happens, or the film would be more than twice as long as its motion");
    return;
  }
  std::vector<std::string> stretches;
  for (const Stretch& one : report.slow_motion) stretches.push_back(to_words(one));
  double motion = 0;
  for (const RunReport& panel : report.panels) motion = std::max(motion, panel.trajectory.end_time);
  if (!stretches.empty())
    notes.push_back(scene.name + ": film lasts " + format_fixed(report.film_seconds(), 1) + " s, its motion " +
                    format_significant(motion, 4) + " s: slow motion at " + (stretches.size() == 1 ? "1 place" : std::to_string(stretches.size()) + " places") +
                    " (--set slow_motion=none): " + joined(stretches));
}

// The picture of an instant between two frames, where a picture of it is wanted and the run comes so far.
std::optional<Moment> moment_between(const std::vector<Output>& outputs, const PreparedFilm& film, double frame, double at, const Fonts& fonts) {
  const auto is_still = [](const Output& output) { return output.shows(Shows::still); };
  if (std::abs(frame - at) <= same_instant(film.panels.front().simulation) || std::none_of(outputs.begin(), outputs.end(), is_still)) return std::nullopt;
  try {
    return moment_at(film, at, fonts);
  } catch (const Error& error) {
    if (error.code() != ExitCode::numerical) throw;
    return std::nullopt;  // the film of such a run fails, too, and is kept as far as it came
  }
}

// What is to be said of a film that became what it is, to its caller or on standard error.
void tell(const FilmReport& report, const RenderJob& job, RenderResult& result) {
  const Scene& page = report.film().scene;
  add_run_notes(report.runs, result.notes);
  add_missing_events(report.runs, result.notes);
  add_own_slow_motion(report, result.notes);
  result.warnings = warning_lines(report);
  if (job.tells) {
    tell_warnings(result.warnings);
    tell_left_out(report.left_out, report.held_text_scale, page, job.quiet);
    if (job.quiet) return;
    for (const std::string& note : result.notes) std::fprintf(stderr, "%s\n", note.c_str());
    return;
  }
  // Nothing has been said of the scenes either.
  std::ranges::move(doubt_lines(report.film().panels), std::back_inserter(result.warnings));
  std::ranges::move(left_out_words(report.left_out, report.held_text_scale, page), std::back_inserter(result.notes));
}

// For LaTeX's package animate, which takes a frame rate as a number and frames by their first and last.
std::string animate_snippet(const Target& target, int frames, FrameRate fps) {
  const SequencePlace place = place_of_sequence(target.path);
  const std::string folder = fs::path(place.folder).filename().string();
  const auto digits = [](int frame) { return PngSequence::file_name("", frame).substr(0, 6); };
  return "% \\usepackage{animate} in the preamble; paths as found from the folder that holds " + folder +
         "/\n\\animategraphics[autoplay,loop,width=\\linewidth]{" + format_shortest(fps.value()) + "}{" +
         folder + "/" + place.stem + "}{" + digits(0) + "}{" + digits(frames - 1) + "}\n";
}

struct Sidecar {
  std::unique_ptr<OutputFile> file;
  enum { audit, words, captions, animate } what;
  Target target;
};

// Beside each clip, or beside the first file where there is none; clips of one name share theirs.
std::vector<Sidecar> open_sidecars(const RenderJob& job, const PreparedFilm& film, bool of_part = false) {
  std::vector<Sidecar> sidecars;
  const bool has_clips = std::any_of(job.targets.begin(), job.targets.end(),
                                     [](const Target& target) { return target.format->shows == Shows::motion; });
  const bool has_captions = !film.scene.annotate.empty() ||
                            std::any_of(film.panels.begin(), film.panels.end(),
                                        [](const PreparedScene& panel) { return !panel.scene.events.empty(); });
  std::set<std::string> seen;
  for (const Target& target : job.targets) {
    if (has_clips && target.format->shows != Shows::motion) continue;
    if (of_part && !target.format->is_sequence) continue;  // it holds them
    const std::string base = !target.format->is_sequence && is_own_sidecar(target.path + ".json") ? target.path : base_of(target);
    const auto open = [&](const char* ending, auto what) {
      require_own_sidecar(base + ending, job.overwrite);
      sidecars.push_back({std::make_unique<OutputFile>(base + ending, job.overwrite), what, target});
    };
    if (target.format->is_sequence) open(".tex", Sidecar::animate);
    if (!seen.insert(base).second || (!has_clips && seen.size() > 1)) continue;
    open(".json", Sidecar::audit);
    open(".txt", Sidecar::words);
    if (has_captions) open(".srt", Sidecar::captions);
  }
  return sidecars;
}

// Frames, rate and size of a clip: small ones have their own.
Json clip_facts_of(const Target& target, const FilmReport& report) {
  const Video& video = report.film().scene.video;
  if (target.format->make_clip == nullptr) return clip_facts(video.width, video.height, video.fps, report.frames);
  const SmallSize small = small_size_of(video.width, video.height, video.fps);
  return clip_facts(small.width, small.height, small.fps, int(small.frames(report.frames)));
}

ClipLength length_of(const Target& target, const FilmReport& report) {
  const Json facts = clip_facts_of(target, report);
  return {facts.at("frames").get<int>(), facts.at("film_seconds").get<double>()};
}

std::string sidecar_text(const Sidecar& sidecar, const FilmReport& report) {
  switch (sidecar.what) {
    case Sidecar::words:
      return alt_text(report, length_of(sidecar.target, report));
    case Sidecar::captions:
      return captions(report);
    case Sidecar::audit:
    case Sidecar::animate:
      break;
  }
  return animate_snippet(sidecar.target, report.frames, report.film().scene.video.fps);
}

// The files as they lie there, in their order, clips with what is in them, pictures with their instant, s, and sequences with
// the hashes of their frames; null for what is no file.
Json audited_files(const RenderJob& job, const std::vector<std::string>& paths, const FilmReport& report, double at) {
  Json files = Json::array();
  for (const std::string& path : paths) {
    std::error_code code;
    if (!fs::is_regular_file(path, code)) {
      files.push_back(nullptr);
      continue;
    }
    Json& file = files.emplace_back(audited_file(path));
    for (const Target& target : job.targets)
      if (target.path == path && target.format->shows == Shows::motion)
        file.update(clip_facts_of(target, report));
      else if (target.path == path && target.format->shows == Shows::still)
        file["at"] = at;
    if (std::ranges::any_of(job.targets, [&](const Target& target) { return target.path == path && target.format->is_sequence; }))
      file[kFrameHashes] = or_null(frame_hashes(path, report.frames));
  }
  return files;
}

// Texts and audit of this name are called x.gif.txt and so on, for each file x.gif that they speak of, where nothing is called so
// yet. The new audits; none where they keep their name.
std::vector<std::string> rename_sidecars(std::vector<Sidecar>& sidecars, const std::string& audit, const RenderJob& job) {
  const auto is_of_audit = [&](const std::string& path) { return fs::path(path).replace_extension(".json") == fs::path(audit); };
  std::vector<Target> own;
  std::ranges::copy_if(job.targets, std::back_inserter(own), [&](const Target& target) { return is_of_audit(target.path); });
  const auto ending_of = [](const Sidecar& sidecar) { return fs::path(sidecar.file->path()).extension().string(); };
  std::vector<Sidecar> renamed;
  std::vector<std::string> audits;
  for (const Target& target : own) {
    if (target.format->is_sequence) return {};
    audits.push_back(target.path + ".json");
    for (const Sidecar& sidecar : sidecars) {
      if (!is_of_audit(sidecar.file->path())) continue;
      const std::string path = target.path + ending_of(sidecar);
      if (fs::exists(fs::symlink_status(path))) return {};
      renamed.push_back({std::make_unique<OutputFile>(path, job.overwrite), sidecar.what, target});
    }
  }
  if (renamed.empty()) return {};
  std::erase_if(sidecars, [&](const Sidecar& sidecar) { return is_of_audit(sidecar.file->path()); });
  std::ranges::move(renamed, std::back_inserter(sidecars));
  return audits;
}

// The scene as found from where the audit of that file lies; "" of one that is no file.
std::string scene_path_from(const std::string& file, const Scene& scene) {
  std::error_code code;
  return fs::is_regular_file(scene.file, code) ? path_from(fs::path(file).parent_path().string(), scene.file) : "";
}

// What audits beside a film's files say of others.
struct OtherAudits {
  std::map<std::string, Json> kept;                                          // by the audit that tells of them on
  std::vector<std::pair<std::unique_ptr<OutputFile>, Json>> without_these;  // audits that told of this film's files, too
  std::vector<std::string> lost;                                             // said of audits that tell of these alone from now on
};

// Other files that an audit of ours tells of already stay in it where they show the very same; where they do not, what is told of
// this one gets a name of its own, or else tells of these alone from now on; either is said.
OtherAudits others_kept(std::vector<Sidecar>& sidecars, const RenderJob& job, const Scene& scene, const std::vector<Output>& outputs, RenderResult& result) {
  OtherAudits audits;
  std::vector<std::string> files;
  for (const Output& output : outputs) {
    if (output.files.empty()) files.push_back(output.target.path);
    for (const std::unique_ptr<OutputFile>& file : output.files) files.push_back(file->path());
  }
  std::vector<std::string> paths;
  for (const Sidecar& sidecar : sidecars)
    if (sidecar.what == Sidecar::audit) paths.push_back(sidecar.file->path());
  for (const std::string& path : paths) {
    Json own = result.audit;
    own[kScenePath] = or_null(scene_path_from(path, scene));
    const OtherFiles others = others_audited(path, files, own);
    const std::string what = joined(others.are_others) + ", which is still there and shows something else: ";
    if (others.are_others.empty()) {
      audits.kept[path] = others.entries;
      continue;
    }
    const std::vector<std::string> renamed = rename_sidecars(sidecars, path, job);
    for (const std::string& audit : renamed) audits.kept[audit] = Json::array();
    if (renamed.empty()) {
      audits.kept[path] = Json::array();
      audits.lost.push_back(path + " told of " + what + "it tells of this film alone now; give both files in one command, or other names");
      continue;
    }
    result.notes.push_back(path + " tells of " + what + joined(renamed) + (renamed.size() > 1 ? " tell of these" : " tells of this one"));
    if (const Json left = audit_without(path, files); !left.is_null())
      audits.without_these.emplace_back(std::make_unique<OutputFile>(path, job.overwrite), left);
  }
  return audits;
}

// Whether NAME.json is the one that tells of the file: by its name, or of a file that none has the name of as the first in its folder.
bool tells_of(const std::vector<Sidecar>& sidecars, const std::string& audit, const std::string& file) {
  const auto is_named = [&](const std::string& one) {
    const auto is_its = [&](const std::string& name) { return fs::path(name) == fs::path(one); };
    return is_its(fs::path(file).replace_extension(".json").string()) || is_its(file + ".json") ||
           std::ranges::any_of(sidecars, [&](const Sidecar& sidecar) { return sidecar.target.path == file && is_its(base_of(sidecar.target) + ".json"); });
  };
  if (is_named(audit)) return true;
  std::vector<std::string> beside;
  for (const Sidecar& sidecar : sidecars)
    if (sidecar.what == Sidecar::audit && (is_named(sidecar.file->path()) || fs::path(sidecar.file->path()).parent_path() == fs::path(file).parent_path()))
      beside.push_back(sidecar.file->path());
  return std::ranges::none_of(beside, is_named) && !beside.empty() && beside.front() == audit;
}

// What an audit says first of frames, rate and size is of the first clip among those that it tells of; without one it stays
// the film's.
void put_first_clip(Json& audit, const RenderJob& job, const FilmReport& report, const auto& is_told) {
  for (const Target& target : job.targets) {
    if (target.format->shows != Shows::motion || !is_told(target)) continue;
    if (target.format->make_clip == nullptr) return;
    const Json clip = clip_facts_of(target, report);
    for (const auto& [key, value] : clip.items()) audit[kDrawnFrames][key] = std::exchange(audit[key], value);
    return;
  }
}

// Texts first: each audit tells of those beside it.
void write_sidecars(std::vector<Sidecar>& sidecars, const RenderJob& job, const FilmReport& report,
                    const OtherAudits& others, RenderResult& result) {
  std::map<fs::path, Json> hashes;  // by NAME.json
  const Json files = result.audit[kAuditedFiles];
  for (Sidecar& sidecar : sidecars) {
    if (sidecar.what == Sidecar::audit) continue;
    const std::string text = sidecar_text(sidecar, report);
    if (text.empty()) continue;  // no event came
    write_whole(*sidecar.file, text);
    const fs::path path(sidecar.file->path());
    hashes[fs::path(path).replace_extension(".json")][path.extension().string()] = sha256_of(text);
  }
  for (Sidecar& sidecar : sidecars) {
    if (sidecar.what != Sidecar::audit) continue;
    Json audit = result.audit;
    const std::string path = sidecar.file->path();
    put_first_clip(audit, job, report, [&](const Target& target) {
      return base_of(target) + ".json" == path || tells_of(sidecars, path, target.path);
    });
    audit[kScenePath] = or_null(scene_path_from(path, report.film().scene));
    audit[kSidecarHashes] = hashes[path];
    audit[kAuditedFiles] = others.kept.at(path);
    for (std::size_t i = 0; i < result.files.size(); ++i)
      if (!files[i].is_null() && tells_of(sidecars, path, result.files[i])) audit[kAuditedFiles].push_back(files[i]);
    write_whole(*sidecar.file, audit.dump(2) + "\n");
  }
  for (const auto& [file, audit] : others.without_these) write_whole(*file, audit.dump(2) + "\n");
  for (const Sidecar& sidecar : sidecars)
    if (sidecar.file->is_done()) result.sidecars.push_back(sidecar.file->path());
}

Json to_json(const StageTimes& times) {
  return {{"simulate", times.simulate.wall},
          {"draw", times.draw.wall},
          {"render", times.render.wall},
          {"encode", times.convert.wall + times.encode.wall + times.mux.wall},
          {"total", times.total}};
}

// What a part of the film says of itself.
std::string part_text(const FilmReport& report, const ClipMemory& memory, FrameRange range, const Json& audit,
                      const Fonts& fonts) {
  const PreparedFilm& film = report.film();
  const Video& video = film.scene.video;
  return to_json(PartFacts{range,
                           report.frames,
                           {.width = video.width,
                            .height = video.height,
                            .fps = video.fps,
                            .crf = video.crf,
                            .alpha = is_transparent(film.scene)},
                           film_hash(memory, fonts),
                           std::string(program_version()) + " (" + program_revision() + ")",
                           libraries_behind(fonts),
                           audit,
                           alt_text(report, {report.frames, report.film_seconds()}),
                           captions(report)})
      .dump(-1, ' ', true);
}

Json held_frames_of(const Schedule& schedule) { return {{"first", schedule.first}, {"last", schedule.last}}; }

// What every file of a film remembers.
ClipMemory memory_of(const FilmReport& report, const Schedule& schedule, const Json& meshes) {
  ClipMemory memory = memory_of(report);
  if (schedule.first > 0 || schedule.last > 0) memory.audit["held_frames"] = held_frames_of(schedule);
  if (!meshes.is_null()) memory.audit[kMeshesHash] = meshes;
  return memory;
}

}  // namespace

namespace {

std::optional<Error> unexpected_end(const Runs& runs) {
  try {
    runs.require_expected_ends();
    return {};
  } catch (const Error& error) {
    if (error.code() != ExitCode::numerical && error.code() != ExitCode::limit) throw;  // a signal
    return error;
  }
}

}  // namespace

ClipMemory memory_of_film(const PreparedFilm& film) {
  const Runs runs(film);
  const Fonts fonts(families_of(film.scene));
  const Schedule schedule = schedule_of(runs);
  const Film pictures = runs.pictures(schedule.frames, fonts);
  return memory_of(film_report(runs, pictures, schedule.total()), schedule, or_null(meshes_hash(film)));
}

RenderResult render_film(const PreparedFilm& film, const RenderJob& job, const Runs* done) {
  const Scene& scene = film.scene;
  const bool is_part = job.part.has_value();
  std::vector<Output> outputs = open_outputs(job.targets, film.panels.size(), job.overwrite, is_part);
  RenderResult result;
  std::vector<Sidecar> sidecars;
  if (!is_part) sidecars = open_sidecars(job, film);

  std::optional<ComingRenderer> renderer = renderer_ahead(outputs, scene, film.panels.size());
  StageClock total, clock;
  std::optional<Runs> own;
  const Runs& runs = done != nullptr ? *done : own.emplace(film);
  result.times.simulate = clock.lap();
  if (std::any_of(runs.list().begin(), runs.list().end(), [](const Trajectory& run) { return run.size() == 0; }))
    runs.require_expected_ends();

  const Fonts fonts(families_of(scene));
  const FrameRate fps = scene.video.fps;
  const Schedule schedule = schedule_of(runs);
  const Film pictures = runs.pictures(schedule.frames, fonts);
  const int total_frames = schedule.total();
  result.frames = total_frames;
  result.film_seconds = frame_time(result.frames, fps);
  const FilmReport report = film_report(runs, pictures, result.frames);
  const Json meshes = or_null(meshes_hash(film));
  const ClipMemory memory = memory_of(report, schedule, meshes);
  result.times.draw += clock.lap();

  result.audit = to_json(report);
  result.audit[kMeshesHash] = meshes;
  result.audit[kSet] = scene.set;
  result.audit[kScenePath] = or_null(job.targets.empty() ? "" : scene_path_from(job.targets.front().path, scene));
  result.audit[kMechanisms] = result.audit[kTables] = Json::array();
  for (const PreparedScene& panel : film.panels) {
    result.audit[kMechanisms].push_back(mechanism_record(panel));
    result.audit[kTables].push_back(driving_tables(panel.scene));
  }
  result.audit["held_frames"] = held_frames_of(schedule);

  const std::optional<Error> trouble = unexpected_end(runs);
  const auto fail = [&] {
    if (job.unfinished) *job.unfinished = result;
    throw Error(*trouble);
  };
  if (trouble && trouble->code() == ExitCode::limit) fail();  // of a run that was lost the film until then is kept
  FrameRange range{0, result.frames};
  std::string part;
  if (is_part) {
    const FilmCuts cuts = cuts_of(outputs, result.frames, fps);
    range = job.part->of(cuts.bounds, cuts.are_fixed);
    result.part = range;
    if (range.empty()) {
      std::fprintf(stderr, "note: %s: %s has no frames: the film has %zu chunks\n", scene.name.c_str(),
                   job.part->text().c_str(), cuts.bounds.size() - 1);
      result.frames = 0;
      return result;
    }
    part = part_text(report, memory, range, result.audit, fonts);
    for (const Output& output : outputs)
      if (output.folder) output.folder->keep_to(range.first, range.behind);
    // Texts beside a sequence are written with its first frame.
    if (range.first == 0) sidecars = open_sidecars(job, film, true);
    result.frames = range.behind - range.first;
  }
  const std::string key = job.resume ? sha256_of(film_hash(memory, fonts) + joined(libraries_behind(fonts), "\n")) : "";

  const int still = std::clamp(runs.clock().frame_at(job.at), 0, schedule.frames - 1);
  result.jobs = affordable_jobs(job.jobs, scene, outputs);
  const double frame_at = runs.times()[std::size_t(still)];
  const std::optional<Moment> between = moment_between(outputs, film, frame_at, job.at, fonts);
  draw_film({pictures, scene, fonts, schedule, still, between ? job.at : frame_at, memory, range, part, key, result.jobs, job.quiet,
             renderer ? &*renderer : nullptr, nullptr, between ? &between->picture : nullptr},
            outputs, result.times);
  write_tables(runs, outputs);
  result.times.total = total.lap().wall;
  result.audit["seconds"] = to_json(result.times);

  throw_if_interrupted();  // a signal leaves nothing
  if (trouble) {
    keep_partial(outputs);
    forget_chunks(outputs, range, total_frames);
    fail();
  }
  if (!is_part) std::ranges::move(leave_foreign_frames(outputs, result.frames), std::back_inserter(result.notes));
  const OtherAudits others = others_kept(sidecars, job, scene, outputs, result);
  tell(report, job, result);
  if (job.tells) tell_warnings(others.lost);
  std::ranges::copy(others.lost, std::back_inserter(result.warnings));
  result.files = commit(outputs);
  result.audit[kAuditedFiles] = audited_files(job, result.files, report, between ? job.at : frame_at);
  forget_chunks(outputs, range, total_frames);
  write_sidecars(sidecars, job, report, others, result);
  if (!is_part) put_first_clip(result.audit, job, report, [](const Target&) { return true; });
  return result;
}

}  // namespace chainreel
