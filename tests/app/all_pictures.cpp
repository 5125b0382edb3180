#include "app/all_pictures.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "app/cli/command.hpp"
#include "app/commands/ellipse_numbers.hpp"
#include "app/film/prepared.hpp"
#include "app/film/runs.hpp"
#include "draw/chart_samples.hpp"
#include "draw/figures/poses.hpp"
#include "draw/film/film.hpp"
#include "model/read_chain.hpp"

namespace chainreel::test {
namespace {

using Words = std::vector<std::string>;

namespace fs = std::filesystem;

// Chaos has not begun anywhere.
constexpr int kFrame = 72;
constexpr double kRightAngle = std::numbers::pi / 2;

// What a film shows, whatever it looks like. Stays where it is made: the runs refer to their film.
struct FilmRun {
  explicit FilmRun(PreparedFilm prepared)
      : film(std::move(prepared)), clock(clock_of(film)), runs(film, clock, clock.frame_times()) {}

  PreparedFilm film;
  FilmClock clock;
  Runs runs;
};

std::shared_ptr<FilmRun> run_film(const std::string& scene, Words overrides, const Words& vary) {
  const std::string file = "assets/scenes/" + scene + ".yaml";
  add_comparison(vary, file, true, overrides);
  return std::make_shared<FilmRun>(load_film(file, overrides));
}

void set_look(Scene& scene, const PictureLook& look) {
  scene.theme = *value_named<ThemeName>(look.theme);
  scene.text_scale = look.text_scale;
  scene.video.width = look.width;
  scene.video.height = look.height;
}

// Its runs and the choice of their method are taken once, for all looks.
AnyPicture frame_of(const std::string& name, const std::string& scene, const Words& more = {},
                    const Words& vary = {}) {
  const auto known = std::make_shared<std::shared_ptr<FilmRun>>();
  const auto show = [=](const PictureLook& look, const Fonts& fonts, const std::function<void(const Film&)>& visit) {
    if (!*known) *known = run_film(scene, more, vary);
    FilmRun& run = **known;
    set_look(run.film.scene, look);
    for (PreparedScene& panel : run.film.panels) set_look(panel.scene, look);
    visit(run.runs.pictures(run.clock.frame_count(), fonts));
  };
  return {name,
          [=](const PictureLook& look, const Fonts& fonts) {
            Picture picture;
            show(look, fonts, [&](const Film& film) {
              picture = film.static_layer();
              picture.append(film.frame(std::min(kFrame, film.frame_count() - 1)));
            });
            return picture;
          },
          show};
}

PoseFigureOptions options_at(const PictureLook& look) {
  PoseFigureOptions options;
  options.width = look.width;
  options.height = look.height;
  options.text_scale = look.text_scale;
  options.theme = &theme_named(look.theme);
  return options;
}

Chain model(const std::string& name) {
  return read_chain("models/" + name + ".urdf", {});
}

AnyPicture poses_of(const std::string& name, const std::string& chain,
                    std::vector<std::vector<double>> poses) {
  return {name, [=](const PictureLook& look, const Fonts& fonts) {
            return draw_pose_figure(model(chain), poses, options_at(look), fonts);
          }};
}

AnyPicture ellipses_of(const std::string& name, const std::string& chain, const PoseSources& sources,
                       const std::string& layout, EllipseReading reading = EllipseReading::mass) {
  return {name, [=](const PictureLook& look, const Fonts& fonts) {
            const Motion motion = sources.along.empty()
                                      ? Motion{model(chain), gather_poses(model(chain), sources), &theme_named(look.theme)}
                                      : motion_of(sources, {});
            PoseFigureOptions options = options_at(look);
            options.title = "Effective mass";
            options.layout = layout;
            options.reading = reading;
            options.labels = motion.poses.labels;
            options.path = motion.poses.path;
            options.cell = motion.poses.cell;
            return draw_ellipse_figure(TipMass(motion.chain, motion.constraints), motion.poses.q, options, fonts);
          }};
}

void add_ellipse_figures(std::vector<AnyPicture>& list) {
  PoseSources two, five, field, along;
  two.poses = {"0,90deg", "0,150deg", "0,0"};
  five.sweep = "q2=30deg:150deg:5";
  field.field = true;
  field.samples = 8;
  along.along = "assets/scenes/rr_free.yaml";
  list.push_back(ellipses_of("ellipse_grid", "rr", five, "grid"));
  list.push_back(ellipses_of("ellipse_row", "rr", two, "row"));
  list.push_back(ellipses_of("ellipse_energy", "rr", two, "grid", EllipseReading::energy));
  list.push_back(ellipses_of("ellipse_belt", "rr", two, "grid", EllipseReading::belt));
  list.push_back(ellipses_of("ellipse_superposed", "rr", five, "superposed"));
  list.push_back(ellipses_of("ellipse_superposed_row", "rr", two, "superposed"));
  list.push_back(ellipses_of("ellipse_field", "rr", field, "grid"));
  list.push_back(ellipses_of("ellipse_along", "rr", along, "superposed"));
  list.push_back({"ellipse_joint_space", [](const PictureLook& look, const Fonts& fonts) {
                    return draw_joint_space_figure(model("rr"), {{0, kRightAngle}, {0, 2}}, {0, 1},
                                                   options_at(look), fonts);
                  }});
}

void add_charts(std::vector<AnyPicture>& list) {
  const auto look_of = [](const PictureLook& look, const Fonts& fonts) {
    return ChartLook{double(look.width) / look.height, look.text_scale, &theme_named(look.theme), &fonts};
  };
  list.push_back({"chart", [=](const PictureLook& look, const Fonts& fonts) {
                    const ChartCost panels[] = {ChartCost::seconds, ChartCost::evaluations};
                    return work_precision_chart(sample_work_precision(), panels, look_of(look, fonts));
                  }});
  list.push_back({"energy_chart", [=](const PictureLook& look, const Fonts& fonts) {
                    return energy_chart(sample_energy(), look_of(look, fonts));
                  }});
  list.push_back({"stability_map", [=](const PictureLook& look, const Fonts& fonts) {
                    return stability_map(sample_map(60, 40), look_of(look, fonts));
                  }});
}

void add_scenes(std::vector<AnyPicture>& list) {
  Words names;
  for (const auto& entry : fs::directory_iterator(fs::path(CHAINREEL_SOURCE_FOLDER) / "assets/scenes"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) list.push_back(frame_of(name, name));
}

void add_films(std::vector<AnyPicture>& list) {
  const std::string forces = "draw=[chain, trail, torque, velocity, gravity, com, legend, time, title]";
  list.push_back(
      frame_of("layers_all", "rr_forces",
               {"draw=[chain, trail, ghosts, com, torque, velocity, gravity, ellipse, frames, mass_matrix, "
                "equation, scale_bar, legend, time, title, torque_label]"}));
  list.push_back(frame_of("compare_layers", "rr_torque",
                          {"draw=[chain, torque, velocity, mass_matrix, legend, time, title]"},
                          {"torque.1=2,-2"}));
  list.push_back(frame_of("grid_layers", "rr_torque", {"draw=[chain, torque, velocity, legend, time, title]"},
                          {"torque.1=1,2", "torque.2=-1,1"}));
  list.push_back(frame_of("grid_twelve", "rr_torque", {}, {"torque.1=-1,0,1,2", "torque.2=-1,0,1"}));
  list.push_back(
      frame_of("plots_right", "rrr_torque", {"plot=[energy, q, tau]", "layout=scene-right", forces, "slow_motion=none"}));
  list.push_back(frame_of("plot_below", "rr_forces", {"plot=energy", "layout=scene-below"}));
  list.push_back(frame_of("compare_plot", "rr_torque", {"plot=energy"}, {"torque.1=2,-2"}));
  list.push_back(frame_of("arm_section", "arm_ellipsoid",
                          {"ellipse.shape=section", "camera.azimuth=60deg",
                           "draw=[chain, ellipse, velocity, ghosts, "
                           "frames, legend, ground, shadow, time]"}));
  list.push_back(frame_of("arm_plain", "arm_ellipsoid", {"links=plain", "camera.distance=parallel"}));
  list.push_back(frame_of("rr_oblique", "rr_forces", {"camera.azimuth=40deg", "links=visual"}));
  list.push_back(frame_of("slow", "rr_torque", {"slow_motion=[{from: 0, until: 1, speed: 0.25}]"}));
  list.push_back(frame_of("transparent", "rr_forces", {"layout=transparent"}));
}

}  // namespace

const std::vector<AnyPicture>& all_pictures() {
  static const std::vector<AnyPicture> list = [] {
    std::vector<AnyPicture> all;
    add_scenes(all);
    add_films(all);
    all.push_back(poses_of("poses_rr", "rr", {{0, kRightAngle}, {0.5, 1}, {1, -1}}));
    all.push_back(poses_of("poses_pp", "pp", {{0.5, 0.5}, {0, -0.5}}));
    add_ellipse_figures(all);
    add_charts(all);
    return all;
  }();
  return list;
}

}  // namespace chainreel::test
