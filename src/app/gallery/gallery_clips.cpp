#include "app/gallery/gallery_clips.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "app/cli/streams.hpp"
#include "app/film/clip_memory.hpp"
#include "app/film/clip_origin.hpp"
#include "app/film/formats.hpp"
#include "app/gallery/gallery_pictures.hpp"
#include "app/report/sidecar.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "picture/formula_words.hpp"
#include "scene/film_clock.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr int kPosterWidth = 960;  // pixels
constexpr double kTellingShare = 0.4;  // of a film without events: its poster

struct ChartKind {
  const char* ending;
  const char* title;
};
constexpr std::array<ChartKind, 3> kChartKinds = {{{"_chart.png", "Speed against accuracy"},
                                                   {"_energy.png", "Energy error over a long time"},
                                                   {"_stability.png", "Where the step is too long"}}};

constexpr std::array<std::string_view, 4> kBestFirst = {".mp4", ".webm", ".apng", ".gif"};

// "video/mp4", or "" of what browsers do not play.
std::string browser_type_of(const fs::path& path) {
  const OutputFormat* format = find_output_format(path.string(), Shows::motion);
  return format ? format->browser_type : "";
}

// A browser believes the name of a file that lies in a page, and holds a page of some hundred MB, no more.
void require_playable(const GalleryClip& clip) {
  const std::string held = "," + clip.start.container + ",", kind = clip.type.substr(clip.type.find('/') + 1);
  if (held.find("," + kind + ",") == std::string::npos)
    throw Error(ExitCode::bad_input, "is named " + lower_case_ending(clip.path) + " but holds " + clip.start.container, {clip.path});
  // A moving picture is read from its start on, and plays without its end.
  const std::string end = kind == "gif" ? ";" : kind == "apng" ? "IEND\xAE\x42\x60\x82" : "";
  if (end.empty()) return;
  std::ifstream stream(clip.path, std::ios::binary);
  std::string last(end.size(), ' ');
  stream.seekg(-std::streamoff(end.size()), std::ios::end);
  stream.read(last.data(), std::streamsize(last.size()));
  if (last != end) throw Error(ExitCode::bad_input, "was cut short: its end is missing", {clip.path});
}

void require_room_in_page(const std::string& path) {
  const auto bytes = fs::file_size(path);
  if (bytes > kLargestClip)
    throw Error(ExitCode::bad_input, "has " + std::to_string(bytes / 1'000'000) + " MB, of which a page holds " +
                                         std::to_string(kLargestClip / 1'000'000) + " at most", {path});
}

// What a run that failed left behind, or what one still writes (NAME.PID.tmp.mp4), is no film to show, unless it is
// asked for.
bool is_partial(const fs::path& path) {
  const fs::path mark = path.stem().extension();
  return mark == ".partial" || mark == ".tmp";
}

// By their names.
void add_films_in(const fs::path& folder, FoundClips& found) {
  std::vector<std::string> in_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    std::error_code code;
    const bool is_clip = find_output_format(path.string(), Shows::motion) != nullptr;
    if (!is_clip || !entry.is_regular_file(code) || is_partial(path)) continue;
    if (browser_type_of(path).empty()) {
      if (!fs::exists(fs::path(path).replace_extension(".mp4"), code)) found.left_out.push_back(path.string());
      continue;
    }
    // The same film once, for which one audit speaks.
    const auto shows_the_same = [&](std::string_view ending) {
      const std::string other = fs::path(path).replace_extension(ending).string();
      return other != path.string() && fs::exists(other, code) && audit_path_of(path.string()) == audit_path_of(other);
    };
    const auto* const own = std::find(kBestFirst.begin(), kBestFirst.end(), lower_case_ending(path.string()));
    (std::any_of(kBestFirst.begin(), own, shows_the_same) ? found.shown_once : in_folder).push_back(path.string());
  }
  std::sort(in_folder.begin(), in_folder.end());
  found.paths.insert(found.paths.end(), in_folder.begin(), in_folder.end());
}

// The text of a file beside a film; "" where there is none, or none that can be read.
std::string read_text(const fs::path& path) {
  constexpr std::uintmax_t kLargestText = std::uintmax_t(64) << 20;  // bytes
  std::error_code code;
  if (!fs::is_regular_file(path, code) || fs::file_size(path, code) > kLargestText) return "";
  note_input(path.string());
  return read_plain_file(path.string(), kLargestText);
}

// The first paragraph of NAME.txt.
std::string words_beside(const fs::path& film) {
  const std::string text = read_text(fs::path(audit_path_of(film.string())).replace_extension(".txt"));
  return text.substr(0, text.find('\n'));
}

// A smaller clip remembers the audit of the frames that were drawn: of its own tells the file beside it; else nothing.
void count_own_frames(GalleryClip& clip) {
  if (!clip.audit.is_object() || !clip.type.starts_with("image/")) return;
  clip.audit.erase("frames");
  const Json beside = audit_beside(clip.path);
  if (!beside.is_object()) return;
  for (const Json& file : audited_files_of(beside))
    if (word_of(file, "file") == fs::path(clip.path).filename().string() && file.contains("frames")) clip.audit["frames"] = file["frames"];
}

// Title, words, scene and audit: of the film itself, else of the files beside it.
void remember(GalleryClip& clip) {
  ClipMemory memory;
  try {
    memory = recall(clip.path);
  } catch (const Error& error) {
    clip.why_no_scene = "it was not made by `chainreel render`, or what it said was taken out since";
  }
  clip.scene = memory.scene;
  clip.audit = memory.audit.is_object() && !memory.audit.empty() ? memory.audit : audit_beside(clip.path);
  count_own_frames(clip);
  // The audit's title says what the scene's leaves open: when it falls.
  if (clip.audit.is_object() && clip.audit.value("title", Json()).is_string())
    memory.title = clip.audit["title"];
  clip.title = memory.title.empty() ? clip.name : in_plain_words(memory.title);
  clip.words = words_beside(clip.path);
  if (clip.words.empty()) clip.words = memory.description;
  if (clip.words.empty()) clip.words = "A film of which nothing is told.";
  // The title stands above the words already.
  const std::string prefix = clip.title + ": ";
  if (clip.words.size() > prefix.size() && clip.words.starts_with(prefix)) clip.words.erase(0, prefix.size());
  clip.words[0] = char(std::toupper(static_cast<unsigned char>(clip.words[0])));
}

// The kind of a chart by the ending of its file's name, whose other part names its film.
const ChartKind* kind_of(const std::string& name) {
  for (const ChartKind& kind : kChartKinds)
    if (name.ends_with(kind.ending)) return &kind;
  return nullptr;
}

// A chart belongs to the film whose name it begins with, the longest of them: rr_free_long_chart.png to
// rr_free_long rather than to rr_free.
void add_charts(std::vector<GalleryClip>& clips) {
  std::set<fs::path> folders;
  for (const GalleryClip& clip : clips) folders.insert(fs::path(clip.path).parent_path());
  for (const fs::path& folder : folders) {
    std::set<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder))
      if (std::error_code code; kind_of(entry.path().filename().string()) && entry.is_regular_file(code))
        files.insert(entry.path());
    for (const fs::path& file : files) {
      const std::string name = file.filename().string();
      GalleryClip* owner = nullptr;
      for (GalleryClip& clip : clips)
        if (fs::path(clip.path).parent_path() == folder && name.starts_with(clip.name + "_") &&
            (!owner || clip.name.size() > owner->name.size()))
          owner = &clip;
      if (owner) owner->charts.push_back({file.string(), kind_of(name)->title});
    }
  }
}

// The film's, as its audit tells of it; of a motion that came to `end`.
FilmClock clock_of(const Json& audit, double end) {
  std::vector<Stretch> stretches;
  for (const Json& slow : audit.value("slow_motion", Json::array()))
    stretches.push_back({slow.at("from").get<double>(), slow.at("until").get<double>(), slow.at("speed").get<double>(),
                         slow.value("ease", Json()).is_number() ? slow["ease"].get<double>() : 0.0});
  for (const Stretch& one : stretches) end = std::max(end, one.until);
  std::vector<Pause> pauses;
  for (const Json& pause : audit.value("pauses", Json::array()))
    pauses.push_back({pause.at("at").get<double>(), pause.at("seconds").get<double>()});
  return FilmClock(end, {}, stretches, pauses);
}

// Where the film first stands still to point at something, s of the film.
std::optional<double> first_pause(const Json& audit, double film_seconds) {
  std::optional<double> first;
  for (const Json& pause : audit.value("pauses", Json::array())) {
    const double middle = pause.at("film_from").get<double>() + pause.at("seconds").get<double>() / 2;
    if (middle >= 0 && middle <= film_seconds) first = std::min(first.value_or(middle), middle);
  }
  return first;
}

}  // namespace

bool is_chart_name(const std::string& name) {
  return kind_of(name) != nullptr;
}

std::string played_endings(const std::string& last_word) {
  return endings_of([](const OutputFormat& row) { return row.shows == Shows::motion && *row.browser_type != 0; }, last_word);
}

Point button_place(const Image& poster) {
  constexpr int kSteps = 6;                                     // to each side
  constexpr double kFarthest = 0.15, kRadius = 0.055, kPerWay = 0.5;  // of the width; of what it covers, for all of that way
  constexpr int kLevels = 24;                                   // of 255, by which ink differs from the page
  const Pixel page = poster.at(0, 0);
  const auto is_ink = [&](int x, int y) {
    const Pixel p = poster.at(x, y);
    return std::max({std::abs(p.r - page.r), std::abs(p.g - page.g), std::abs(p.b - page.b)}) > kLevels;
  };
  const double width = poster.width, height = poster.height, radius = kRadius * width, step = kFarthest * std::min(width, height) / kSteps;
  const auto covered = [&](double x, double y) {
    int ink = 0, all = 0;
    for (int j = int(std::max(0.0, y - radius)); j < std::min(height, y + radius); ++j)
      for (int i = int(std::max(0.0, x - radius)); i < std::min(width, x + radius); ++i)
        if (std::hypot(i - x, j - y) < radius) ink += is_ink(i, j), ++all;
    return double(ink) / std::max(all, 1);
  };
  Point best{0.5, 0.5};
  double least = HUGE_VAL;
  for (int j = -kSteps; j <= kSteps; ++j)
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double x = width / 2 + i * step, y = height / 2 + j * step;
      const double cost = covered(x, y) * (1 + kPerWay) + kPerWay * std::hypot(i, j) / kSteps * kRadius;
      if (cost < least) least = cost, best = {x / width, y / height};
    }
  return best;
}

double poster_time(const Json& audit, double film_seconds) {
  const double otherwise = kTellingShare * film_seconds;
  try {
    std::optional<double> last;  // of the motion
    double end = 0;
    const auto look = [&](const Json& run) {
      for (const Json& event : run.value("events", Json::array()))
        last = std::max(last.value_or(0), event.at("t").get<double>());
      end = std::max({end, last.value_or(0), run.value("end_time", 0.0)});
    };
    look(audit);
    for (const Json& panel : audit.value("panels", Json::array())) look(panel);
    if (!last) return first_pause(audit, film_seconds).value_or(otherwise);
    double held = 0;
    if (audit.contains("held_frames"))
      held = audit["held_frames"].at("first").get<double>() * film_seconds / audit.at("frames").get<double>();
    const double film = held + clock_of(audit, end).film_time(*last);
    return film >= 0 && film <= film_seconds ? film : otherwise;
  } catch (const Json::exception&) {
    return otherwise;  // an audit of a strange kind
  }
}

FoundClips find_clips(const std::vector<std::string>& paths) {
  FoundClips found;
  ProblemList problems;
  for (const std::string& path : paths) {
    std::error_code code;
    if (fs::is_directory(path, code)) {
      add_films_in(path, found);
      std::ranges::move(pictures_in(path, found.left_out, found.shown_once), std::back_inserter(found.pictures));
    } else if (!fs::is_regular_file(path, code))
      problems.add("there is no such file or folder", {path});
    else if (!picture_type_of(path).empty())
      found.pictures.push_back(path);
    else if (browser_type_of(path).empty())
      problems.add("is no film or picture for browsers: a gallery takes " + played_endings("and") + ", and pictures as " + shown_endings("and"), {path});
    else
      found.paths.push_back(path);
  }
  problems.throw_if_any();
  // Each once, where it is named first.
  std::set<std::string> seen;
  for (auto* list : {&found.paths, &found.pictures}) std::erase_if(*list, [&](const std::string& path) { return !seen.insert(path).second; });
  std::sort(found.left_out.begin(), found.left_out.end());
  std::sort(found.shown_once.begin(), found.shown_once.end());
  if (!found.paths.empty() || !found.pictures.empty()) return found;
  throw Error(ExitCode::bad_input, "there is no film (" + played_endings("or") + ") and no picture of ours here: render some first", {joined(paths)});
}

std::vector<GalleryClip> read_clips(const std::vector<std::string>& paths) {
  std::vector<GalleryClip> clips;
  std::vector<Problem> problems;
  for (const std::string& path : paths) {
    throw_if_interrupted();
    GalleryClip clip;
    clip.path = path;
    clip.name = fs::path(path).stem().string();
    clip.type = browser_type_of(path);
    note_input(path);
    try {
      require_room_in_page(path);
      clip.start = read_film_start(path, kPosterWidth);
      require_playable(clip);
      remember(clip);
      clip.start = read_film_start(path, kPosterWidth, poster_time(clip.audit, clip.start.seconds));
      clips.push_back(std::move(clip));
    } catch (const Error& error) {
      for (Problem problem : error.problems()) {
        problem.message += "; render it again or move it away";
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw Error(ExitCode::bad_input, std::move(problems));
  add_charts(clips);
  return clips;
}

}  // namespace chainreel
