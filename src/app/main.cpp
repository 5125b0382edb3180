// chainreel: every command.
#include "app/cli/command.hpp"
#include "app/commands/equations_command.hpp"
#include "app/main_program.hpp"

namespace {

void add_commands(chainreel::CommandLine& app) {
  using namespace chainreel;
  add_render_command(app);
  add_join_command(app);
  add_bench_command(app);
  add_snapshot_command(app);
  add_ellipse_command(app);
  add_simulate_command(app);
  add_extract_command(app);
  add_compare_command(app);
  add_dynamics_command(app);
  add_equations_command(app, run_equations_elsewhere);
  add_inverse_command(app);
  add_init_command(app);
  add_check_command(app);
  add_doctor_command(app);
  add_methods_command(app);
  add_chart_command(app);
  add_energy_command(app);
  add_stability_command(app);
  add_sweep_command(app);
  add_fall_command(app);
  add_sheet_command(app);
  add_gallery_command(app);
  add_verify_command(app);
  add_schema_command(app);
  add_completion_command(app);
  add_help_command(app);
}

}  // namespace

int main(int argc, char** argv) {
  return chainreel::main_program(argc, argv, add_commands);
}
