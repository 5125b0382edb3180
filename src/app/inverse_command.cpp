// chainreel inverse MODEL --trajectory q.csv -o tau.csv

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/report.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/rnea.hpp"
#include "model/read_chain.hpp"
#include "sim/reference.hpp"

namespace chainreel {
namespace {

struct InverseOptions {
  std::string model;
  std::string trajectory;
  std::string output;
  std::string gravity;
  CommonOptions common;
};

// A row per instant of the trajectory: t,tau1..
std::string torques_text(const Chain& chain, const std::vector<double>& times, const Reference& reference) {
  Workspace ws(chain);
  std::vector<double> q(std::size_t(chain.nv)), qd(q), qdd(q);
  std::string text = "t";
  for (int i = 1; i <= chain.nv; ++i) text += ",tau" + std::to_string(i);
  for (const double t : times) {
    reference.evaluate(t, q, qd, qdd);
    compute_inverse_dynamics(chain, ws, q, qd, qdd);
    compute_friction(chain, ws, qd);
    text += "\n" + format_exact(t);
    for (std::size_t i = 0; i < q.size(); ++i) text += "," + format_exact(ws.tau[i] + ws.tau_f[i]);
  }
  return text + "\n";
}

void run_inverse(const InverseOptions& options) {
  ModelOptions model = model_options_of(options.common);
  model.meshes = false;
  if (!options.gravity.empty()) model.gravity = parse_gravity(options.gravity);
  const Chain chain = read_chain(options.model, model);
  if (chain.has_floating)
    throw Error(ExitCode::bad_input, "a floating base follows no given joint motion: take --base fixed",
                {options.model});
  const std::unique_ptr<Reference> reference = make_table_reference(options.trajectory, chain.nv);
  const std::vector<double> times = read_time_table(options.trajectory, {}, chain.nv).t;
  const std::string text = torques_text(chain, times, *reference);

  std::string output = options.output;
  if (output.empty())
    output = "out/" + std::filesystem::path(options.trajectory).stem().string() + "_tau.csv";
  if (output == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  write_text_file(output, text, options.common.force);
  if (options.common.json)
    std::puts(Json{{"file", output}, {"rows", times.size()}}.dump(2).c_str());
  else if (!options.common.quiet)
    std::printf("%s  %zu rows\n", output.c_str(), times.size());
}

}  // namespace

void add_inverse_command(CommandLine& app) {
  auto options = std::make_shared<InverseOptions>();
  Command* command = app.add_subcommand("inverse", "the torques that a motion takes, from CSV to CSV");
  command->add_option("model", options->model, "a model (.urdf)").required();
  command
      ->add_option("--trajectory", options->trajectory,
                   "a .csv with t,q1.. and maybe qd1.., qdd1.. (else splines)")
      .required();
  command->add_option("-o,--output", options->output, "a .csv file, or - (default out/TRAJECTORY_tau.csv)");
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  add_common_options(*command, options->common);
  command->footer("Example: chainreel inverse models/rr.urdf --trajectory out/rr_free.csv -o out/tau.csv");
  command->callback([options] { run_inverse(*options); });
}

}  // namespace chainreel
