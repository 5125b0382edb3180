#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "app/cli/command.hpp"
#include "app/cli/streams.hpp"
#include "app/guide/reference.hpp"
#include "app/report/version.hpp"
#include "core/error.hpp"
#include "core/machine.hpp"
#include "render/gl_backend.hpp"

namespace {

int run(int argc, char** argv) {
  using namespace chainreel;
  CommandLine app(
      "chainreel", "chainreel: from a scene file to a film of a robot chain moving under given torques.",
      program_version(),
      "Exit codes: " + exit_code_words() +
          ".\nWhat scenes may say, methods, constraints, outputs: chainreel help\n"
          "Example: chainreel render assets/scenes/rr_free.yaml");
  app.add_choice("--gl", "CHAINREEL_GL", words_of(names_of(GlBackend{})),
                 "where OpenGL comes from: auto takes OSMesa, else EGL; the bytes are the same",
                 [](const std::string& word) { choose_gl_backend(*value_named<GlBackend>(word)); });
  add_render_command(app);
  add_join_command(app);
  add_bench_command(app);
  add_snapshot_command(app);
  add_ellipse_command(app);
  add_simulate_command(app);
  add_extract_command(app);
  add_compare_command(app);
  add_dynamics_command(app);
  add_equations_command(app);
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
  add_help_command(app);
  return app.run(argc, argv);
}

// Whatever went wrong, in words and as an exit code.
int run_and_tell(int argc, char** argv) {
  using namespace chainreel;
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    print_error(error);
    return int(error.code());
  } catch (const std::bad_alloc&) {
    std::fputs(kOutOfMemory, stderr);
    return int(ExitCode::limit);
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "%s: %s\n", error.path1().c_str(), error.code().message().c_str());
    return int(ExitCode::bad_input);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "chainreel: %s\n", error.what());
    return int(ExitCode::file);
  }
}

}  // namespace

int main(int argc, char** argv) {
  chainreel::give_large_memory_back();
  chainreel::guard_streams();
  chainreel::install_last_words();
  chainreel::install_signal_handlers();
  const int code = run_and_tell(argc, argv);
  if (chainreel::flush_standard_output() || code != int(chainreel::ExitCode::good)) return code;
  return int(chainreel::ExitCode::file);
}
