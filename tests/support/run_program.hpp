// Runs a program to its end, or to its time limit, and keeps all it said.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace chainreel {

// Of a command line.
using Words = std::vector<std::string>;
inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct ProgramResult {
  int status = -1;         // exit status; 128 + number where a signal ended it
  bool timed_out = false;  // it was ended by us
  std::string out;
  std::string err;
  long peak = 0;  // KiB of memory; not below what the test itself had when it was started
};

struct RunOptions {
  std::string folder{};                              // "": where the test runs, the root of the source tree
  std::map<std::string, std::string> environment{};  // set or replaced on top of the test's own
  double timeout_s = 120;
};

// Programs and tests have the address sanitizer, which keeps memory of its own, and what was freed.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

// For LD_PRELOAD: the library, behind the sanitizer's where the program has that.
inline std::string preloaded(const std::string& library) {
  return kIsSanitized ? "libasan.so.8 " + library : library;
}

// The path of the built program, whether it has been built or not.
std::string program_path();

// `chainreel ARGUMENTS...`. Throws std::runtime_error where the program cannot be started.
ProgramResult run_program(const std::vector<std::string>& arguments, const RunOptions& options = {});

// Lines that the program told, in a shell that ends with the first that fails and finds the built program by its name.
ProgramResult run_told(const std::string& lines, const std::string& folder = "");

// Any command; command[0] is looked up in PATH.
ProgramResult run_command(const std::vector<std::string>& command, const RunOptions& options = {});

}  // namespace chainreel
