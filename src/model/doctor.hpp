// The model doctor: what is wrong, doubtful or ignored in a URDF file, for `chainreel check MODEL`.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/read_chain.hpp"

namespace chainreel {

struct Finding {
  enum class Severity {
    error,    // read_chain refuses the model
    warning,  // it can be simulated, but is probably not what was meant
    note,     // good to know
  };
  Severity severity = Severity::note;
  std::string message;
  Place place;
};

std::string to_string(Finding::Severity severity);

// Errors first, then warnings and notes, each in the order of the file. Findings of one kind are told at most
// kMostOfAKind times, then counted. Never throws for what is wrong with the file.
std::vector<Finding> examine_model(const std::string& path, const ModelOptions& options = {});

inline constexpr int kMostOfAKind = 5;

}  // namespace chainreel
