#include "app/main_program.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "app/cli/last_words.hpp"
#include "app/cli/streams.hpp"
#include "app/guide/reference.hpp"
#include "app/report/version.hpp"
#include "core/error.hpp"
#include "core/machine.hpp"
#include "render/gl_backend.hpp"
#include "render/renderer_pins.hpp"

namespace chainreel {
namespace {

int run(int argc, char** argv, void (*add_commands)(CommandLine&)) {
  CommandLine app(
      "chainreel", "chainreel: from a scene file to a film of a robot chain moving under given torques.",
      program_version(),
      "Exit codes: " + exit_code_words() +
          ".\nWhat scenes may say, methods, constraints, outputs: chainreel help\n"
          "Example: chainreel render rr_free");
  app.add_choice("--gl", "CHAINREEL_GL", words_of(names_of(GlBackend{})),
                 "where OpenGL comes from, and whether it is needed: the bytes are the same",
                 [](const std::string& word) { choose_gl_backend(*value_named<GlBackend>(word)); });
  app.add_choice("--warnings", "CHAINREEL_WARNINGS", words_of(names_of(AfterWarnings{})),
                 "what comes of a WARNING: fail ends with exit code 1 where one was told, behind all that is written",
                 [](const std::string& word) { choose_after_warnings(*value_named<AfterWarnings>(word)); });
  add_commands(app);
  return app.run(argc, argv);
}

// Whatever went wrong, in words and as an exit code.
int run_and_tell(int argc, char** argv, void (*add_commands)(CommandLine&)) {
  try {
    return run(argc, argv, add_commands);
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

int main_program(int argc, char** argv, void (*add_commands)(CommandLine&)) {
  give_large_memory_back();
  guard_streams();
  settle_environment();
  install_last_words();
  install_signal_handlers();
  int code = run_and_tell(argc, argv, add_commands);
  if (code == int(ExitCode::good) && fails_by_warnings()) code = int(ExitCode::comparison_failed);
  if (flush_standard_output() || code != int(ExitCode::good)) return code;
  return int(ExitCode::file);
}

}  // namespace chainreel
