// Model files made by tests, and what reading them gives.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "model/read_chain.hpp"

namespace chainreel {

// A folder of its own for a test, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "chainreel_model_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Writes a file, with the folders that it needs, and gives its path.
  std::string write(const std::string& name, const std::string& content) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  }

 private:
  std::filesystem::path path_;
};

// The pieces of a URDF; what is left out has the values that a test does not care for.
inline std::string link_text(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}

inline std::string inertial_text(
    double mass = 1, const std::string& com = "0.5 0 0",
    const std::string& inertia = "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'") {
  return "<inertial><origin xyz='" + com + "'/><mass value='" + std::to_string(mass) + "'/><inertia " +
         inertia + "/></inertial>";
}

inline std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                              const std::string& child, const std::string& axis = "0 0 1",
                              const std::string& inside = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
         child + "'/><axis xyz='" + axis + "'/>" + inside + "</joint>\n";
}

inline std::string robot_text(const std::string& inside) {
  return "<robot name='test'>\n" + inside + "</robot>\n";
}

// A moving link and the joint that it hangs on.
inline std::string moving(const std::string& name, const std::string& type, const std::string& parent,
                          const std::string& axis = "0 0 1", const std::string& inside = "") {
  return link_text(name, inertial_text()) + joint_text("to_" + name, type, parent, name, axis, inside);
}

inline Chain chain_from(const std::string& text, const ModelOptions& options = {}) {
  const TemporaryFolder folder;
  return read_chain(folder.write("model.urdf", text), options);
}

// What reading says, or "" where it succeeds. What is wrong with a file is bad input, or too much of it.
inline std::string refusal_of(const std::string& path, const ModelOptions& options = {}) {
  try {
    read_chain(path, options);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::limit) << error.what();
    return error.what();
  }
  return "";
}

}  // namespace chainreel
