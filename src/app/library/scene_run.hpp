// What other programs call: a scene that is run, with its numbers, its pictures and its films. It passes the same stations as
// the commands, so that the numbers and bytes are theirs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/image.hpp"
#include "model/chain.hpp"
#include "sim/drive/torque_function.hpp"
#include "sim/system/trajectory.hpp"

namespace chainreel {

struct SceneRequest {
  std::string path;                    // of a scene, or the name of one that comes with the program; of a text, what errors call it
  std::optional<std::string> text{};   // YAML or JSON, in the file's place; its paths start in the folder of `path`
  std::vector<std::string> overrides{};  // "duration=2", as `--set` takes them
  std::optional<OwnTorque> torque{};   // drives the joints; the scene may then have no torque of its own
};

struct FilmRequest {
  std::vector<std::string> files;  // .mp4, .webm, .gif, .png, ..: what `render -o` takes
  double at = 0;                   // s of the motion, that single pictures show
  int jobs = 0;                    // threads; 0: all processors
  bool overwrite = false;          // files that stand there, unless they lie below a folder `out`
};

struct FilmFiles {
  std::vector<std::string> files;     // in the order of the request
  std::vector<std::string> sidecars;  // audit, words, captions
  std::vector<std::string> notes;     // what of the scene it does not show, or shows otherwise
  int frames = 0;
  double seconds = 0;
};

// Of the whole mechanism at each sample, J.
struct EnergyCourse {
  std::vector<double> kinetic, potential;
  std::vector<double> total;  // with that of springs, see SpringEnergy
  std::vector<double> error;  // kinetic + potential - the same at the start - work of the torques, springs among them, and of friction
};

// An array of a table: an entry a row, of that shape; empty: one number.
struct RunArray {
  std::string name;                // "qdd"
  std::vector<std::size_t> shape;  // of an entry
  std::vector<double> values;      // row by row
};

// All of it may be asked for by several threads, one after the other. Everything throws Error.
class SceneRun {
 public:
  // Reads, checks and runs the scene, sampled at the frames of its film, but for slow motion that the
  // film has by itself, and at the end of its motion; or at `times`, which rise
  // within its duration. Throws Error where it cannot be read or does not end as the scene expects, and what the torque
  // function threw.
  explicit SceneRun(SceneRequest request, std::vector<double> times = {});
  ~SceneRun();
  SceneRun(SceneRun&&) noexcept;
  SceneRun& operator=(SceneRun&&) noexcept;

  // A panel each; a scene that compares nothing has one. Panels count from 0. References live as long as the run.
  int panels() const;
  const std::string& title(int panel = 0) const;
  const Chain& chain(int panel = 0) const;
  const Trajectory& trajectory(int panel = 0) const;
  std::vector<std::string> event_names(int panel = 0) const;  // that Trajectory::events counts
  // nv numbers a sample, N m or N, as the run felt them, friction left out.
  const std::vector<double>& torques(int panel = 0) const;
  const EnergyCourse& energy(int panel = 0) const;

  // What `simulate --columns` writes, "t,qdd,lambda,x_G": a row a sample, but one of samples at one instant.
  std::vector<RunArray> table(const std::string& columns, int panel = 0) const;

  std::string name() const;               // of the scene's file, without its ending
  std::string effective_scene() const;    // YAML with every default filled in
  std::string report(int panel = 0) const;  // JSON, as `simulate --json` prints it of a panel
  std::vector<std::string> warnings() const;  // what speaks against the run, and what was changed of the scene; a line each

  FilmFiles film(const FilmRequest& request) const;
  // The film's page at an instant, s; width and height in pixels, 0: the scene's. `notes` takes what it does not show.
  Image frame(double at, int width = 0, int height = 0, std::vector<std::string>* notes = nullptr) const;
  // The same as a .png, .svg or .pdf.
  void picture(double at, const std::string& path, bool overwrite = false, std::vector<std::string>* notes = nullptr) const;

 private:
  struct State;
  class Asked;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
