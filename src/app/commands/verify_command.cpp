// chainreel verify SUITE: pictures of models and scenes against those that were accepted.

#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/film/progress.hpp"
#include "app/report/compared_picture.hpp"
#include "app/report/report.hpp"
#include "app/report/version.hpp"
#include "app/verify/baselines.hpp"
#include "app/verify/html_report.hpp"
#include "app/verify/shots.hpp"
#include "app/verify/verdict.hpp"
#include "app/verify/verify_report.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/machine.hpp"
#include "core/output_file.hpp"
#include "core/parallel.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct VerifyOptions {
  std::string suite;
  std::vector<std::string> accept;  // empty: all that are chosen
  std::optional<Option> accept_option;
  bool accepts = false;
  bool refit = false;
  bool prune = false;
  std::string missing = "fail";
  std::vector<std::string> filters;
  int jobs = 0;  // all cores
  std::string junit, markdown, html, output;
  CommonOptions common;
};

bool matches(const SuitePicture& picture, const std::vector<std::string>& filters) {
  return filters.empty() || std::any_of(filters.begin(), filters.end(), [&](const std::string& filter) {
           return fnmatch(filter.c_str(), picture.name.c_str(), 0) == 0;
         });
}

// A pose in several themes or variants is several pictures, which its name stands for.
bool is_called(const SuitePicture& picture, const std::string& name) {
  const std::filesystem::path source(picture.source);
  return picture.name == name || picture.pose == name || source.filename() == name || source.stem() == name;
}

bool is_pattern(const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos;
}

std::vector<const SuitePicture*> chosen_pictures(const Suite& suite, const VerifyOptions& options) {
  std::vector<const SuitePicture*> chosen;
  std::vector<std::string> names;
  for (const SuitePicture& picture : suite.pictures) {
    names.push_back(picture.name);
    if (matches(picture, options.filters)) chosen.push_back(&picture);
  }
  const auto meant = [&](const std::string& name) {
    const std::string words = did_you_mean(name, names);
    return words.empty() ? "." : ":" + words;
  };
  ProblemList problems;
  for (const std::string& name : options.accept) {
    const auto is_it = [&](const SuitePicture* picture) { return is_called(*picture, name); };
    if (std::none_of(suite.pictures.begin(), suite.pictures.end(), [&](const SuitePicture& picture) { return is_called(picture, name); }))
      problems.add("--accept " + name + ": the suite has no such picture" +
                       (is_pattern(name) ? "; patterns go with --filter, behind a plain --accept" : "") + meant(name) + " It has " +
                       shortened(joined(names), 500),
                   {});
    else if (std::none_of(chosen.begin(), chosen.end(), is_it))
      problems.add("--accept " + name + ": --filter leaves this picture out: name it there, too, or give no --filter",
                   {});
  }
  for (const std::string& filter : options.filters)
    if (std::none_of(suite.pictures.begin(), suite.pictures.end(),
                     [&](const SuitePicture& picture) { return matches(picture, {filter}); }))
      problems.add("--filter " + filter + " matches none of the suite's pictures: " + shortened(joined(names), 500), {});
  problems.throw_if_any(ExitCode::usage);
  return chosen;
}

bool is_accepted(const VerifyOptions& options, const SuitePicture& picture) {
  if (!options.accepts) return false;
  return options.accept.empty() ||
         std::any_of(options.accept.begin(), options.accept.end(), [&](const std::string& name) { return is_called(picture, name); });
}

std::vector<std::string> words_of(const Error& error) {
  std::vector<std::string> words;
  for (const Problem& problem : error.problems()) words.push_back(to_string(problem));
  return words;
}

// Verdicts of pictures in their order, one line each, as soon as those before are there; on a terminal those that passed leave no
// line.
class Teller {
 public:
  Teller(const std::vector<PictureVerdict>& verdicts, const VerifyOptions& options)
      : verdicts_(verdicts),
        is_there_(verdicts.size()),
        quiet_(options.common.quiet || options.common.json),
        progress_("verify", int(verdicts.size()), quiet_ || !isatty(2)),
        terminal_(isatty(1)) {}

  void tell(std::size_t which) {
    const std::lock_guard lock(mutex_);
    progress_.update(++done_);
    is_there_[which] = true;
    while (next_ < verdicts_.size() && is_there_[next_]) tell(verdicts_[next_++]);
  }

 private:
  void tell(const PictureVerdict& verdict) {
    if (quiet_ || verdict.state == PictureState::accepted ||
        (terminal_ && verdict.passes && verdict.state == PictureState::same))
      return;
    std::printf("%-8s  %s\n", to_string(verdict.state).c_str(), verdict.name.c_str());
    if (verdict.state != PictureState::same && verdict.state != PictureState::accepted)
      for (const std::string& words : said_.words_of(verdict)) std::printf("          %s\n", words.c_str());
    std::fflush(stdout);
  }

  const std::vector<PictureVerdict>& verdicts_;
  std::vector<bool> is_there_;
  SaidOnce said_;
  std::size_t next_ = 0;
  bool quiet_;
  Progress progress_;
  bool terminal_;
  int done_ = 0;
  std::mutex mutex_;
};

// What is accepted: written as it comes, so that memory holds no picture longer than it takes, and taken at once in the end.
class Acceptance {
 public:
  Acceptance(const Suite& suite, const Baselines& baselines) : suite_(suite), baselines_(baselines) {}

  // Begins with the first that is asked for. Safe among threads.
  BaselineUpdate& change() {
    const std::lock_guard lock(mutex_);
    if (!change_) change_ = std::make_unique<BaselineUpdate>(suite_, baselines_);
    return *change_;
  }
  bool has_begun() const { return change_ != nullptr; }

 private:
  const Suite& suite_;
  const Baselines& baselines_;
  std::unique_ptr<BaselineUpdate> change_;
  std::mutex mutex_;
};

class Verification {
 public:
  Verification(const Suite& suite, const VerifyOptions& options, const Baselines& baselines,
               const Cameras& cameras, Acceptance& acceptance)
      : suite_(suite),
        options_(options),
        baselines_(baselines),
        cameras_(cameras),
        acceptance_(acceptance) {}

  // By several threads, a few pictures of one source at a time: what they share is loaded once a thread.
  std::vector<PictureVerdict> run(const std::vector<const SuitePicture*>& pictures) {
    std::vector<std::pair<std::size_t, std::size_t>> pieces;
    const std::size_t longest = std::max<std::size_t>(
        1, (pictures.size() + std::size_t(options_.jobs) - 1) / std::size_t(options_.jobs));
    for (std::size_t i = 0; i < pictures.size();) {
      std::size_t end = i + 1;
      while (end < pictures.size() && end - i < longest && share_source(*pictures[end], *pictures[i]))
        ++end;
      pieces.emplace_back(i, end);
      i = end;
    }
    std::vector<PictureVerdict> verdicts(pictures.size());
    Teller teller(verdicts, options_);
    for_each_index(pieces.size(), options_.jobs, [&](std::size_t piece) {
      Studio studio(suite_, cameras_);
      for (std::size_t i = pieces[piece].first; i < pieces[piece].second; ++i) {
        throw_if_interrupted();
        verdicts[i] = verdict_of(*pictures[i], studio);
        teller.tell(i);
      }
    });
    return verdicts;
  }

 private:
  PictureVerdict verdict_of(const SuitePicture& picture, Studio& studio) {
    SuiteShot shot;
    try {
      // What cannot be fitted cannot be drawn, and says why.
      if (!suite_.fit && !cameras_.contains(source_name(suite_, picture))) studio.fitted(picture);
      shot = studio.shoot(picture);
    } catch (const Error& error) {
      if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
      return without(PictureState::failed, suite_, picture, words_of(as_said_in(suite_, error)));
    }
    const bool is_new = !baselines_.has(picture.name);
    if (is_accepted(options_, picture) || (is_new && options_.missing == "write")) {
      acceptance_.change().set(picture.name, shot);
      return without(PictureState::accepted, suite_, picture,
                     shot.leaves_camera ? std::vector<std::string>{kLeavesCamera} : std::vector<std::string>{});
    }
    if (is_new) {
      PictureVerdict verdict =
          without(PictureState::missing, suite_, picture,
                  {"there is no baseline: look at the picture, then --accept " + picture.name +
                   ", or take all that are missing with --missing write"});
      if (shot.leaves_camera) verdict.words.push_back(kLeavesCamera);
      verdict.actual_png = png_bytes(shot.image);
      return verdict;
    }
    try {
      return judge(suite_, picture, shot, baselines_.read(picture.name), studio);
    } catch (const Error& error) {
      PictureVerdict verdict = without(PictureState::baseline, suite_, picture, words_of_baseline(error, picture));
      verdict.actual_png = png_bytes(shot.image);
      return verdict;
    } catch (const Json::exception&) {
      PictureVerdict verdict = without(
          PictureState::baseline, suite_, picture,
          {baselines_.folder() + "/" + picture.name +
           ".json: holds other things than a baseline's facts: restore it, or --accept " + picture.name});
      verdict.actual_png = png_bytes(shot.image);
      return verdict;
    }
  }

  // What its records hold is read by those who know nothing of files.
  std::vector<std::string> words_of_baseline(const Error& error, const SuitePicture& picture) const {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems)
      if (problem.place.file.empty())
        problem = {problem.message + ": restore it, or --accept " + picture.name,
                   {baselines_.folder() + "/" + picture.name + ".json"}};
    return words_of(Error(error.code(), std::move(problems)));
  }

  const Suite& suite_;
  const VerifyOptions& options_;
  const Baselines& baselines_;
  const Cameras& cameras_;
  Acceptance& acceptance_;
};

// A picture that is new while another one is gone may be that one under another name, or at another instant.
void tell_of_former_names(SuiteResult& result) {
  if (result.unused.empty()) return;
  for (PictureVerdict& one : result.pictures)
    if (one.state == PictureState::missing)
      one.words.push_back("there are baselines whose pictures are gone: " +
                          shortened(joined(result.unused), 200));
}

std::vector<std::string> unused_baselines(const Suite& suite, const Baselines& baselines) {
  std::set<std::string> names = baselines.names();
  for (const SuitePicture& picture : suite.pictures) names.erase(picture.name);
  return {names.begin(), names.end()};
}

// A source with baselines had a camera, unless it was the suite's own: where that is gone, another one may have been fitted.
std::vector<std::string> lost_cameras(const Suite& suite, const Baselines& baselines, const Cameras& kept) {
  std::vector<std::string> notices;
  std::set<std::string> seen;
  for (const SuitePicture& picture : suite.pictures) {
    const std::string source = source_name(suite, picture);
    if (suite.fit || kept.contains(source) || !baselines.has(picture.name) || !seen.insert(source).second) continue;
    notices.push_back("the camera of " + source + " is missing in " + baselines.camera_file() +
                      ", and was fitted to what is drawn now: restore that file, or take the new one with --accept --refit");
  }
  return notices;
}

// What is accepted and pruned, in one go.
void update(const VerifyOptions& options, const Cameras& cameras, Acceptance& acceptance,
            SuiteResult& result) {
  if (!acceptance.has_begun() && !(options.prune && !result.unused.empty())) return;
  BaselineUpdate& change = acceptance.change();
  if (options.prune)
    for (const std::string& name : result.unused) change.remove(name);
  change.set_cameras(cameras);
  change.commit();
  if (options.prune) std::swap(result.pruned, result.unused);
}

// What an earlier run left there is replaced.
bool replaces(const VerifyOptions& options, const std::string& report) {
  return options.common.force || is_own_report(report);
}

// Pictures of what failed, for who has no report.
void write_pictures(const std::string& folder, const SuiteResult& result, bool overwrite) {
  for (const PictureVerdict& one : result.pictures) {
    const auto write = [&](const char* what, const std::string& png) {
      const std::string path = (fs::path(folder) / (one.name + what)).string();
      if (one.passes || png.empty())  // what an earlier run left there is no more true
        remove_compared_picture(path);
      else
        write_text_file(path, with_png_text(png, compared_picture_text()), overwrite || is_compared_picture(path));
    };
    write(".expected.png", one.expected_png);
    write(".actual.png", one.actual_png);
    write(".difference.png", one.difference_png);
  }
}

// Two results in one file would be one.
void require_distinct_outputs(const VerifyOptions& options) {
  std::set<fs::path> seen;
  for (const std::string& path : {options.junit, options.markdown, options.html, options.output})
    if (!path.empty() && !seen.insert(fs::weakly_canonical(path)).second)
      throw Error(ExitCode::usage, path + " is named twice: each result has a file of its own");
}

// Before anything is drawn: what cannot be written, or has no place among the baselines.
void require_writable_outputs(const VerifyOptions& options, const Baselines& baselines) {
  const fs::path folder = fs::weakly_canonical(baselines.folder());
  for (const std::string& path : {options.junit, options.markdown, options.html, options.output}) {
    if (path.empty()) continue;
    const fs::path target = fs::weakly_canonical(path);
    if (std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first == folder.end())
      throw Error(ExitCode::usage, path + " lies in the folder of the baselines: name another place");
    if (path != options.output) const OutputFile allowed(path, replaces(options, path));  // throws where it is not
  }
  if (!options.output.empty() && fs::exists(options.output) && !fs::is_directory(options.output))
    throw Error(ExitCode::usage, "-o " + options.output + " is a file: name a folder");
}

VerifyReport page_of(const SuiteResult& result) {
  VerifyReport report;
  report.suite = result.suite;
  report.accept_command = accept_command(result);
  report.program = std::string("chainreel ") + program_version();
  report.unused = unused_words(result);
  for (const PictureVerdict& one : result.pictures)
    report.pictures.push_back({one.name, to_string(one.state), one.source, one.words, one.expected_png,
                               one.actual_png, one.difference_png, one.difference.worst,
                               one.difference.beyond, one.tolerance, one.passes});
  return report;
}

void write_reports(const VerifyOptions& options, const SuiteResult& result) {
  const auto write = [&](const std::string& path, const std::string& text) { write_text_file(path, text, replaces(options, path)); };
  if (!options.junit.empty()) write(options.junit, junit_text(result));
  if (!options.markdown.empty()) write(options.markdown, markdown_text(result));
  if (!options.html.empty()) write_html_report(options.html, page_of(result), replaces(options, options.html));
  if (!options.output.empty()) write_pictures(options.output, result, options.common.force);
}

void tell_verdicts(const VerifyOptions& options, const SuiteResult& result) {
  if (options.common.json) return print_json(to_json(result));
  for (const std::string& notice : result.notices) std::fprintf(stderr, "%s\n", notice.c_str());
  if (options.common.quiet) return;
  for (const PictureVerdict& one : result.pictures)
    if (one.state == PictureState::accepted) {
      std::printf("accepted  %s\n", one.name.c_str());
      for (const std::string& words : one.words) std::printf("          %s\n", words.c_str());
    }
  for (const std::string& name : result.unused)
    std::printf("unused    %s: no picture of the suite has this name; --prune removes it\n", name.c_str());
  for (const std::string& name : result.pruned) std::printf("pruned    %s\n", name.c_str());
  if (result.failed() == 0) std::printf("%s\n", summary_of(result).c_str());
  if (const std::string accept = accept_command(result); !accept.empty()) std::printf("to take what is drawn now: %s\n", accept.c_str());
}

// Of the suite as a whole, where nothing came of it: reports of an earlier run are not left to speak for this one.
void report_error(const VerifyOptions& options, const Error& error) {
  SuiteResult result{options.suite, "", {}, {}, {}, {}};
  PictureVerdict none;
  none.name = none.source = fs::path(options.suite).filename().string();
  none.state = PictureState::failed;
  none.passes = false;
  none.words = words_of(error);
  none.tolerance = "none: nothing was drawn";
  result.pictures.push_back(std::move(none));
  VerifyOptions reports = options;
  for (std::string* path : {&reports.junit, &reports.markdown, &reports.html})
    if (!path->empty() && fs::exists(*path) && !replaces(options, *path)) path->clear();  // somebody's own
  reports.output.clear();
  try {
    write_reports(reports, result);
  } catch (const Error&) {
    // What cannot be written there is no news: the error itself is told.
  }
}

void verify(const VerifyOptions& options) {
  const Suite suite = read_suite(options.suite);
  const std::vector<const SuitePicture*> chosen = chosen_pictures(suite, options);
  const bool writes = options.accepts || options.prune || options.missing == "write";
  const SuiteLock lock(suite, writes ? SuiteLock::For::writing : SuiteLock::For::reading);
  const Baselines baselines(suite);
  require_writable_outputs(options, baselines);
  const Cameras kept = options.refit ? Cameras{} : baselines.cameras();
  const Cameras cameras = cameras_of(suite, kept);
  Acceptance acceptance(suite, baselines);
  SuiteResult result{options.suite, baselines.folder(), {}, unused_baselines(suite, baselines), {}, {}};
  result.pictures = Verification(suite, options, baselines, cameras, acceptance).run(chosen);
  throw_if_interrupted();
  result.notices = suite.notes;
  if (!options.refit)
    for (std::string& notice : lost_cameras(suite, baselines, kept)) result.notices.push_back(std::move(notice));
  if (const std::size_t left = suite.pictures.size() - chosen.size(); left > 0)
    result.notices.push_back("--filter leaves " + std::to_string(left) + " of " + std::to_string(suite.pictures.size()) + " pictures out: of them nothing is said");
  tell_of_former_names(result);
  update(options, cameras, acceptance, result);
  write_reports(options, result);
  tell_verdicts(options, result);
  if (result.failed() > 0) throw Error(ExitCode::comparison_failed, summary_of(result), {options.suite});
}

void run_verify(VerifyOptions options) {
  options.accepts = options.accept_option->given();
  std::erase(options.accept, "");
  if (options.jobs == 0) options.jobs = usable_cores();
  if (options.refit && !options.accepts)
    throw Error(ExitCode::usage, "--refit goes with --accept: a new camera makes all pictures new");
  if (options.refit && (!options.accept.empty() || !options.filters.empty()))
    throw Error(ExitCode::usage,
                "--refit changes the camera of every picture: give --accept without names, and no --filter");
  require_distinct_outputs(options);
  try {
    verify(options);
  } catch (const Error& error) {
    if (error.code() != ExitCode::comparison_failed && error.code() != ExitCode::usage) report_error(options, error);
    throw;
  }
}

}  // namespace

void add_verify_command(CommandLine& app) {
  auto options = std::make_shared<VerifyOptions>();
  Command* command = app.add_subcommand("verify", "pictures of a suite against those that were accepted");
  command->add_option("suite", options->suite, "a suite (.yaml), or a folder of scenes or models").required();
  options->accept_option =
      command->add_names("--accept", options->accept,
                         "take what is drawn now as baselines: of the pictures or poses named behind it, else of all that --filter lets through");
  command->add_flag("--refit", options->refit, "with --accept: the cameras that fit what is drawn now");
  command
      ->add_option("--missing", options->missing, "what to do with a picture without baseline: fail or write")
      .one_of({"fail", "write"})
      .show_default();
  command->add_flag("--prune", options->prune, "remove baselines of pictures that the suite no longer has");
  command->add_repeatable("--filter", options->filters,
                          "only pictures whose names match, like 'home*' (repeatable)");
  command->add_option("--jobs", options->jobs, "threads (default: all cores)").range(1, 256);
  command->add_option("--junit", options->junit, "results as JUnit XML");
  command->add_option("--markdown", options->markdown, "a summary as Markdown");
  command->add_option("--html", options->html, "a report as one HTML file");
  command->add_option(
      "-o,--output", options->output,
      "a folder for the pictures of what failed: NAME.expected.png, NAME.actual.png, NAME.difference.png");
  add_result_options(*command, options->common);
  command->footer("What a suite may say: chainreel help snapshots\n"
                  "Example: chainreel verify arm.yaml --junit out/junit.xml --html out/report.html --missing write\n"
                  "with arm.yaml: {model: rr.urdf, poses: {home: [0, 0]}}; without --missing write from the second time on");
  command->callback([options] { run_verify(*options); });
}

}  // namespace chainreel
