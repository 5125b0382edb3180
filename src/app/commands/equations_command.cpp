// chainreel equations MODEL | SCENE [--latex | --document | --python] [--theta] [-o FILE]
#include "app/commands/equations_command.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/input_file.hpp"

namespace chainreel {
namespace {

// Beside this program as built, and as installed.
constexpr const char* kPlaces[] = {"chainreel-equations", "../libexec/chainreel/chainreel-equations"};

// The words that this process was started with.
std::vector<std::string> own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

// For the program that comes in this one's place: a scene can be read from there once.
void put_on_standard_input(const std::string& text) {
  const int file = memfd_create("stdin", 0);
  std::size_t done = 0;
  while (file >= 0 && done < text.size()) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count <= 0) break;
    done += std::size_t(count);
  }
  if (file < 0 || done < text.size() || lseek(file, 0, SEEK_SET) != 0 || dup2(file, STDIN_FILENO) < 0)
    throw Error(ExitCode::file, std::string("cannot be handed on: ") + std::strerror(errno), {kStandardInput});
}

}  // namespace

void run_equations_elsewhere(const EquationsOptions& options) {
  std::vector<std::string> words = own_words();
  // The file as it was found, of which has been told.
  for (std::string& word : words)
    if (word != "-" && word != options.file && shipped_file(word) == options.file) word = options.file;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  if (const std::string* text = standard_input_at(kStandardInput)) put_on_standard_input(*text);
  const std::filesystem::path folder = program_file().parent_path();
  for (const char* place : kPlaces) execv((folder / place).c_str(), pointers.data());
  throw Error(ExitCode::no_renderer, "chainreel-equations cannot be started from " + folder.string() + ": " + std::strerror(errno) +
                                         "; it is part of every build and package, install them whole");
}

void add_equations_command(CommandLine& app, void (*run)(const EquationsOptions&)) {
  auto options = std::make_shared<EquationsOptions>();
  Command* command = app.add_subcommand(
      "equations", "M(q), C(q, qd), g(q), J and Lambda of a chain of up to four joints in symbols, as text, LaTeX or Python");
  command->add_option("file", options->file, "a model (.urdf) or a scene (.yaml)").required().names_input(".urdf");
  command->add_flag("--latex", options->latex, "as LaTeX, for amsmath");
  command->add_flag("--document", options->document, "LaTeX that can be typeset as it is, with a table of what its letters stand for");
  command->add_flag("--python", options->python, "as a module of Python with functions of numpy arrays");
  command->add_flag("--theta", options->theta, "angles are called theta, not q");
  command->add_option("--only", options->only, "of text and LaTeX these parts alone: equation, M, C, g, tau_f, J, Lambda, as in equation,M,g");
  add_panel_option(*command, options->panel);
  command->add_option("--gravity", options->gravity, "world x,y,z in m/s^2");
  command->add_option("--end-effector", options->end_effector, "the link that J and Lambda speak of");
  command->add_option("-o,--output", options->outputs,
                      "a .tex (LaTeX, to be read by \\input, or whole with --document), .py (Python), .json or .txt file; several -o make several (default: standard output)");
  add_scene_options(*command, options->common);
  add_json_option(*command, options->common);
  add_force_option(*command, options->common);
  command->footer("Example: chainreel equations rr.urdf -o rr.tex");
  options->command = command;
  command->callback([options, run] { run(*options); });
}

}  // namespace chainreel
