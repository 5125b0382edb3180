// Findings as they are gathered, and the separate looks that make up the doctor's examination.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/doctor.hpp"
#include "model/urdf_file.hpp"

namespace chainreel {

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
