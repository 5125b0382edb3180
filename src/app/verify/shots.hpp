// The pictures of a suite as the program draws them now, each with the physics behind it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/film/clip_memory.hpp"
#include "core/image.hpp"
#include "core/json.hpp"
#include "draw/robot/view.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "render/canvas.hpp"
#include "scene/text/suite.hpp"

namespace chainreel {

struct SuiteShot {
  Picture picture;
  int width = 0, height = 0;  // px
  const Fonts* fonts = nullptr;  // the studio's
  Image image;
  ClipMemory memory;
  // {source, model, names, q}, or {source, t, run}: `model` and `run` are records
  // (app/verify/physics_record).
  Json physics;
  Json page;  // all else that pixels depend on: theme, fonts, renderer, program
  bool has_bars = false;  // what it shows of a model are bars, which have none of its file's shapes and colours
  bool leaves_camera =
      false;  // the suite's camera, which was fitted to what the baselines show, cuts something off
};

// What the pictures of each source are seen by, by its source_name, over all pictures of it. Sources and pictures that have a camera of
// their own are left out.
using Cameras = std::map<std::string, KeptCamera>;
// As baselines keep them: those of the part, then those of the eye, if it has one.
std::vector<double> numbers_of(const KeptCamera& camera);

// Draws pictures of a suite, those of one source the fastest one after the other. For one thread.
class Studio {
 public:
  // Both must outlive it.
  Studio(const Suite& suite, const Cameras& cameras);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // Throws Error where a model, a scene or its run is at fault.
  SuiteShot shoot(const SuitePicture& picture);
  // The same picture with all its shapes moved, px to the right and up.
  Image moved(const SuiteShot& shot, double right, double up);
  // What the pictures of its source and variant show where nothing but what they hold decides.
  KeptCamera fitted(const SuitePicture& picture);

 private:
  class Source;
  class ModelSource;
  class SceneSource;
  Source& source_of(const SuitePicture& picture);
  const Fonts& fonts_of(const Source& source);
  Image rasterise(const Picture& picture, int width, int height, const Fonts& fonts);

  const Suite& suite_;
  const Cameras& cameras_;
  std::map<std::array<std::string, 3>, std::unique_ptr<Fonts>> fonts_;  // by the families of label, bold, math
  std::unique_ptr<Source> source_;  // the last one
  std::unique_ptr<Canvas> canvas_;  // the last one
  int canvas_width_ = 0, canvas_height_ = 0;
  const Fonts* canvas_fonts_ = nullptr;
};

// Its source as the suite's folder sees it, the same wherever the folder lies, and its variant: "swing.yaml (dark)".
std::string source_name(const Suite& suite, const SuitePicture& picture);

// With what `known` lacks fitted anew, where that can be done.
Cameras cameras_of(const Suite& suite, Cameras known);

}  // namespace chainreel
