#include "app/verify/shots.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "app/film/instants.hpp"
#include "app/film/model_scene.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "app/report/alt_text.hpp"
#include "app/report/version.hpp"
#include "app/verify/physics_record.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/machine.hpp"
#include "draw/figures/poses.hpp"
#include "draw/page/house_style.hpp"
#include "draw/robot/view.hpp"
#include "picture/place_picture.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

std::vector<const SuitePicture*> pictures_beside(const Suite& suite, const SuitePicture& one) {
  std::vector<const SuitePicture*> all;
  for (const SuitePicture& picture : suite.pictures)
    if (share_source(picture, one)) all.push_back(&picture);
  return all;
}

std::string list_override(const std::string& key, std::span<const double> numbers) {
  std::string text = key + "=[";
  for (std::size_t i = 0; i < numbers.size(); ++i) text += (i > 0 ? ", " : "") + format_shortest(numbers[i]);
  return text + "]";
}

void add_camera(const KeptCamera& camera, std::vector<std::string>& overrides) {
  overrides.push_back(list_override("camera.fit", camera.part));
  if (!camera.eye) return;
  overrides.push_back(list_override("camera.focus", std::span(*camera.eye).first(3)));
  overrides.push_back("camera.distance=" + format_shortest(camera.eye->back()));
}

// Keys of the suite, and the camera that its baselines have; a suite's own `fit` is among its keys. Those of a variant come last.
std::vector<std::string> overrides_for(const Suite& suite, const SuitePicture& picture, const KeptCamera* kept) {
  std::vector<std::string> overrides = suite.overrides;
  if (suite.fit)
    overrides.push_back(list_override("camera.fit", *suite.fit));
  else if (kept)
    add_camera(*kept, overrides);
  overrides.insert(overrides.end(), picture.overrides.begin(), picture.overrides.end());
  return overrides;
}

// The part of the world that is shown, and by which eye; null where that is what fits.
Json camera_of(const Suite& suite, const KeptCamera* kept) {
  return suite.fit ? Json(*suite.fit) : kept ? Json(numbers_of(*kept)) : Json(nullptr);
}

// What a picture depends on beyond its own: the program, the machine and the faces of fonts, those included that stand in.
Json page_of(const Picture& picture, const Fonts& fonts, const RendererInfo& renderer) {
  Json page{{"program", program_version()}};
  page["processor"] = processor_architecture();
  page["renderer"] = renderer.renderer + ", " + renderer.version;  // whichever library brought it
  std::set<Face> faces{Face::label, Face::label_bold, Face::math};
  for (const Item& item : picture.items)
    if (const auto* run = std::get_if<GlyphRun>(&item.shape)) faces.insert(run->face);
  for (const Face face : faces)
    page["fonts"][fs::path(fonts.file(face)).filename().string()] = fonts.sha256(face);
  return page;
}

}  // namespace

// A model or a scene with all that its pictures share.
class Studio::Source {
 public:
  explicit Source(const SuitePicture& first) : first_(first) {}
  virtual ~Source() = default;
  const std::string& path() const { return first_.source; }
  bool has(const SuitePicture& picture) const { return share_source(first_, picture); }

  virtual FontFamilies families() const = 0;
  virtual SuiteShot draw(const SuitePicture& picture, const Fonts& fonts) = 0;
  virtual KeptCamera fitted(const Fonts& fonts) = 0;

 private:
  SuitePicture first_;
};

// A model at poses.
class Studio::ModelSource : public Source {
 public:
  ModelSource(const Suite& suite, const SuitePicture& first, const KeptCamera* part)
      : Source(first),
        pictures_(pictures_beside(suite, first)),
        is_pinned_(part || suite.fit),
        model_(model_scene_of(path(), overrides_for(suite, first, part), "verify", keys_of_models(OfModel::picture))),
        chain_(read_chain(path(), model_.options)),
        record_(model_record(path(), model_.options,
                             model_.scene.links == LinkShapes::collision ? DescribeCollisions::all
                                                                         : DescribeCollisions::where_seen)),
        name_(source_name(suite, first)),
        keys_(overrides_for(suite, first, nullptr)),
        camera_(camera_of(suite, part)) {
    set_look(figure_, model_, chain_);
  }

  FontFamilies families() const override { return families_of(model_.scene); }

  SuiteShot draw(const SuitePicture& picture, const Fonts& fonts) override {
    const PoseFigureOptions options = options_for(picture);
    SuiteShot shot;
    shot.width = options.width;
    shot.height = options.height;
    shot.picture = draw_pose_figure(chain_, {picture.q}, options, fonts);
    shot.has_bars = figure_.shapes == nullptr;
    shot.leaves_camera = is_pinned_ && leaves_page(chain_, picture.q, options, fonts);
    shot.physics = {
        {"source", name_}, {"names", position_names(chain_)}, {"q", picture.q}, {"model", record_}};
    shot.page = {{"theme", to_string(model_.scene.theme)}, {"keys", keys_}, {"camera", camera_}};
    shot.memory.title = chain_.name;
    std::vector<std::string> numbers;
    for (const double q : picture.q) numbers.push_back(format_shortest(q));
    shot.memory.figure = {{"arguments", {"snapshot", name_, "--pose=" + joined(numbers, ",")}},
                          {"files", {1}},
                          {"poses", {picture.q}},
                          {"model", name_},
                          {"model_sha256", sha256_of_file(path())}};
    return shot;
  }

  KeptCamera fitted(const Fonts& fonts) override {
    std::vector<std::vector<double>> poses;
    for (const SuitePicture* picture : pictures_) poses.push_back(picture->q);
    return camera_of_poses(chain_, poses, options_for(*pictures_.front()), fonts);
  }

 private:
  PoseFigureOptions options_for(const SuitePicture& picture) const {
    PoseFigureOptions options = figure_;
    if (picture.width > 0) options.width = picture.width;
    if (picture.height > 0) options.height = picture.height;
    return options;
  }

  std::vector<const SuitePicture*> pictures_;
  bool is_pinned_;
  ModelScene model_;
  Chain chain_;
  Json record_;
  std::string name_;
  std::vector<std::string> keys_;  // what the suite says of the look
  Json camera_;
  PoseFigureOptions figure_;
};

// A scene at instants. Its run is computed once, and once more for each instant between the frames: that is a sample more,
// which trails and plots hold, too, and no other picture may depend on it.
class Studio::SceneSource : public Source {
 public:
  SceneSource(const Suite& suite, const SuitePicture& first, const KeptCamera* part)
      : Source(first),
        pictures_(pictures_beside(suite, first)),
        film_(load_film(path(), overrides_for(suite, first, part))),
        clock_(clock_of(film_)),
        plain_(film_, clock_, clock_.frame_times()),
        record_(run_record(film_, plain_)),
        name_(source_name(suite, first)) {}

  FontFamilies families() const override { return families_of(film_.scene); }

  SuiteShot draw(const SuitePicture& picture, const Fonts& fonts) override {
    const double at = instant_of(picture);
    Instants instants = instants_of(film_, clock_, {at});
    const int frame = instants.frames.front();
    std::optional<Runs> own;
    if (!instants.added.empty()) own.emplace(film_, clock_, std::move(instants.times));
    const Runs& runs = own ? *own : plain_;
    runs.require_expected_ends(frame);
    std::unique_ptr<Film> own_pages;
    if (own) own_pages = pages_of(*own, picture, fonts);
    const Film& film = own ? *own_pages : film_for(picture, fonts);
    FilmReport report = film_report(runs, film, frames_of_film(runs, instants.added));
    report.writes = Writes::pictures;
    SuiteShot shot;
    shot.width = film_.scene.video.width;
    shot.height = film_.scene.video.height;
    shot.picture = film.still(frame);
    shot.memory = memory_of(report);
    shot.memory.audit["at"] = at;
    shot.physics = {{"source", name_}, {"t", at}, {"run", record_}};
    shot.page = {{"theme", to_string(film_.scene.theme)}};
    for (const PreparedScene& panel : film_.panels) shot.has_bars = shot.has_bars || !panel.shapes;
    for (const RunReport& run : report.panels)
      shot.leaves_camera = shot.leaves_camera || (run.left_picture_at && *run.left_picture_at <= at);
    return shot;
  }

  KeptCamera fitted(const Fonts& fonts) override {
    const Film& film = film_for(*pictures_.front(), fonts);
    return kept_camera(film.camera(), film.scene_area());
  }

 private:
  // Events by their names, else by what they say.
  double instant_of(const SuitePicture& picture) const {
    if (picture.telling) return telling_instant(plain_);
    if (picture.event.empty()) {
      if (picture.at <= film_.scene.duration) return picture.at;
      throw Error(ExitCode::bad_input,
                  "at " + format_shortest(picture.at) + " s lies behind the scene's duration of " +
                      format_shortest(film_.scene.duration) + " s",
                  picture.place);
    }
    if (const std::optional<double> first = first_time_of(plain_, picture.event)) return *first;
    throw Error(ExitCode::bad_input,
                "event '" + picture.event + "' does not happen in " + path() + ": " + known_events(),
                picture.place);
  }

  std::string known_events() const {
    std::vector<std::string> names;
    for (const PreparedScene& panel : film_.panels)
      for (const EventEntry& event : panel.scene.events) names.push_back(event.title());
    return names.empty() ? "it has no events" : "its events are " + joined(names);
  }

  std::unique_ptr<Film> pages_of(const Runs& runs, const SuitePicture& picture, const Fonts& fonts) {
    film_.scene.video.width = picture.width;
    film_.scene.video.height = picture.height;
    const bool ends = runs.size() == 1 && film_.scene.expect != Outcome::diverge;
    const int frames = int(runs.times().size());
    return std::make_unique<Film>(runs.pictures(ends ? std::min(frames, runs[0].size()) : frames, fonts));
  }

  const Film& film_for(const SuitePicture& picture, const Fonts& fonts) {
    if (!pages_ || width_ != picture.width || height_ != picture.height) {
      pages_ = pages_of(plain_, picture, fonts);
      width_ = picture.width;
      height_ = picture.height;
    }
    film_.scene.video.width = width_;
    film_.scene.video.height = height_;
    return *pages_;
  }

  std::vector<const SuitePicture*> pictures_;
  PreparedFilm film_;
  FilmClock clock_;
  Runs plain_;
  Json record_;
  std::string name_;
  std::unique_ptr<Film> pages_;  // at the film's frames, of the last size
  int width_ = 0, height_ = 0;   // that size, px
};

Studio::Studio(const Suite& suite, const Cameras& cameras) : suite_(suite), cameras_(cameras) {}
Studio::~Studio() = default;

Studio::Source& Studio::source_of(const SuitePicture& picture) {
  if (source_ && source_->has(picture)) return *source_;
  source_ = nullptr;
  const auto known = cameras_.find(source_name(suite_, picture));
  const KeptCamera* part = known == cameras_.end() ? nullptr : &known->second;
  if (picture.is_model)
    source_ = std::make_unique<ModelSource>(suite_, picture, part);
  else
    source_ = std::make_unique<SceneSource>(suite_, picture, part);
  return *source_;
}

const Fonts& Studio::fonts_of(const Source& source) {
  const FontFamilies families = source.families();
  std::unique_ptr<Fonts>& fonts = fonts_[{families.label, families.bold, families.math}];
  if (!fonts) fonts = std::make_unique<Fonts>(families);
  return *fonts;
}

SuiteShot Studio::shoot(const SuitePicture& picture) {
  Source& source = source_of(picture);
  const Fonts& fonts = fonts_of(source);
  SuiteShot shot = source.draw(picture, fonts);
  shot.fonts = &fonts;
  shot.image = rasterise(shot.picture, shot.width, shot.height, fonts);
  shot.page.update(page_of(shot.picture, fonts, canvas_->info()));
  return shot;
}

Image Studio::moved(const SuiteShot& shot, double right, double up) {
  Picture picture;
  picture.aspect = shot.picture.aspect;
  picture.background = shot.picture.background;
  const double x = right / shot.height, y = up / shot.height;
  place_picture(picture, shot.picture, {{x, y, shot.picture.aspect + x, 1 + y}});
  return rasterise(picture, shot.width, shot.height, *shot.fonts);
}

KeptCamera Studio::fitted(const SuitePicture& picture) {
  Source& shown = source_of(picture);
  return shown.fitted(fonts_of(shown));
}

Image Studio::rasterise(const Picture& picture, int width, int height, const Fonts& fonts) {
  if (!canvas_ || canvas_width_ != width || canvas_height_ != height || canvas_fonts_ != &fonts) {
    canvas_ = nullptr;
    canvas_ = std::make_unique<Canvas>(width, height, fonts);
    canvas_fonts_ = &fonts;
    canvas_width_ = width;
    canvas_height_ = height;
  }
  Image image;
  canvas_->draw(picture, image);
  return image;
}

namespace {

std::string file_seen_by(const Suite& suite, const std::string& source) {
  const fs::path folder =
      fs::is_directory(suite.file) ? fs::path(suite.file) : fs::path(suite.file).parent_path();
  const fs::path from = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
  // What comes with the program goes by its name: baselines do not depend on where that is installed.
  const std::string shipped = name_of_shipped(source);
  std::error_code ignored;
  if (!shipped.empty() && !fs::exists(from / shipped, ignored)) return shipped;
  const fs::path name = fs::absolute(source).lexically_normal().lexically_relative(from);
  return printable(name.empty() ? source : name.generic_string());  // a name may be no text
}

}  // namespace

std::vector<double> numbers_of(const KeptCamera& camera) {
  std::vector<double> numbers(camera.part.begin(), camera.part.end());
  if (camera.eye) numbers.insert(numbers.end(), camera.eye->begin(), camera.eye->end());
  return numbers;
}

std::string source_name(const Suite& suite, const SuitePicture& picture) {
  const std::string file = file_seen_by(suite, picture.source);
  return picture.variant.empty() ? file : file + " (" + picture.variant + ")";
}

Cameras cameras_of(const Suite& suite, Cameras known) {
  if (suite.fit) return {};
  const Cameras none;
  Studio studio(suite, none);
  Cameras cameras;
  for (const SuitePicture& picture : suite.pictures) {
    const std::string name = source_name(suite, picture);
    if (cameras.contains(name)) continue;
    if (const auto found = known.find(name); found != known.end()) {
      cameras[name] = found->second;
      continue;
    }
    try {
      cameras[name] = studio.fitted(picture);
    } catch (const Error& error) {
      if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated) throw;
      // Its pictures cannot be drawn, which is told of them; others can.
    }
  }
  return cameras;
}

}  // namespace chainreel
