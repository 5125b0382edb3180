// The model doctor: what is wrong, doubtful or ignored in a URDF file, for `chainreel check MODEL`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "model/read_chain.hpp"
#include "model/urdf_file.hpp"

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

// Of a file that was read, what it says that is not read, but was likely meant: "arm.urdf:12: .. did you mean 'damping'?".
std::vector<std::string> slips_of(const UrdfFile& file);

// Findings as they are gathered, and the separate looks that make up the doctor's examination.

class DoctorReport {
 public:
  explicit DoctorReport(std::string path) : path_(std::move(path)) {}

  // `kind` names what several such findings are: "joints without <limit>".
  void add(Finding::Severity severity, const std::string& kind, int line, std::string message);
  void add_errors(const Error& error);

  std::vector<Finding> sorted();

 private:
  struct Kind {
    Finding::Severity severity = Finding::Severity::note;
    int count = 0;
    int first_unlisted_line = 0;
  };

  std::string path_;
  std::vector<Finding> findings_;
  std::map<std::string, Kind> kinds_;
};

// What was noted while the file was read.
void examine_remarks(const UrdfFile& file, DoctorReport& report);
void examine_angles(const UrdfOrigin& origin, const std::string& owner, int line, DoctorReport& report);
void examine_tags(const UrdfFile& file, DoctorReport& report);
void examine_joints(const UrdfFile& file, DoctorReport& report);
// Inertias, shapes and their sizes; meshes are searched and measured.
void examine_links(const UrdfFile& file, const ModelOptions& options, DoctorReport& report);

}  // namespace chainreel
