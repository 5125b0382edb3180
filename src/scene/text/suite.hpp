// A suite: pictures that are verified against baselines. `snapshots.yaml` names models with poses, or scenes
// with instants, and how they are looked at. A folder is a suite, too: the `snapshots.yaml` in it, else each
// scene in it at its telling moment and each model at rest.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace chainreel {

// When two pictures count as the same; see compare/compare_images.
struct SuiteTolerance {
  double error = 0.1;      // perceptual, 0 to 1: a pixel beyond it is different
  int pixels = 0;          // how many may be
  bool count_edges = false;  // as anti-aliasing differs is a difference, too
  Place place;             // where it was set, so that a failure can say so
  bool is_default = true;  // it was set nowhere
};

struct SuitePicture {
  std::string name;    // unique, fit for a file name; order is the user's
  std::string source;  // the .urdf or .yaml as found from the working folder
  bool is_model = false;
  std::vector<double> q;  // of a model: chain.nq numbers
  double at = 0;          // s, of a scene: an instant ..
  std::string event;      // .. or the first time that the event of this name happens ..
  bool telling = false;   // .. or the moment that says most
  std::string variant;    // its name; "": the source as it is
  std::vector<std::string> overrides;  // those of the variant, behind the suite's own
  std::string pose;       // the pose's or instant's name as the user wrote it; "" where none was asked for
  int width = 640, height = 360;
  SuiteTolerance tolerance;
  std::vector<std::array<int, 4>> masks;  // x y width height, px from the upper left; within the picture
  Place place;                            // of the pose or instant
};

// Whether both show one scene or model with the same keys.
inline bool share_source(const SuitePicture& a, const SuitePicture& b) {
  return a.source == b.source && a.variant == b.variant;
}

// What a variant sets, KEY=VALUE as for --set, and where it says so.
struct SuiteOverride {
  std::string text;
  Place place;
};
struct SuiteVariant {
  std::string name;
  std::vector<SuiteOverride> overrides;
  Place place;
};

// Key `physics`: what is made of physics other than the baseline's.
enum class OtherPhysics { fail, motion, note };

struct Suite {
  std::string file;  // as given; of a folder with `snapshots.yaml`, that file
  std::string name;  // stem
  std::vector<SuitePicture> pictures;
  std::optional<std::array<double, 4>>
      fit;  // `camera: fit`, m: left, bottom, right, top; it is not among the overrides
  std::vector<std::string> overrides;  // what the suite sets of all scenes and models, KEY=VALUE as for --set
  std::vector<Place> override_places;  // where it says so, a place each
  std::vector<SuiteVariant> variants;  // each source is shown once a variant; none: once
  OtherPhysics other_physics = OtherPhysics::fail;
  std::vector<std::string> notes;  // models that come with the program, as none of their names lie beside the suite or its scenes
};

// Reads each model once. Throws Error with every problem: file, line, remedy.
Suite read_suite(const std::string& path);

// The error with the suite's own lines in the place of overrides that it sets.
Error as_said_in(const Suite& suite, const Error& error);

}  // namespace chainreel
