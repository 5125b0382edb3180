// The words of `chainreel equations`. GiNaC, which computes them, takes 4 ms to load: it is in an executable of its own that
// lies beside this one, and no other command pays for it.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"

namespace chainreel {

struct EquationsOptions {
  std::string file;
  int panel = 0;  // of a scene, from 1; 0: the only one
  std::string gravity, end_effector;
  std::string only;  // "M,g"; "": all parts
  std::vector<std::string> outputs;
  bool latex = false, document = false, python = false, theta = false;
  CommonOptions common;
  const Command* command = nullptr;
};

// `run` is called with what the command line says.
void add_equations_command(CommandLine& app, void (*run)(const EquationsOptions&));

// Goes over into chainreel-equations with the same words. Throws Error (no renderer, codec or font) where it is missing.
void run_equations_elsewhere(const EquationsOptions& options);

}  // namespace chainreel
