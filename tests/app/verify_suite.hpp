// What tests of suites share: a small one, and what `verify` says of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/json.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {

// A suite of three poses beside the model that it shows.
class Verify : public ::testing::Test {
 protected:
  Verify() {
    write("rr.urdf", read_whole_file("models/rr.urdf"));
    write("arm.yaml", "model: rr.urdf\nsize: 320x180\nposes: {home: [0, 0], up: [90deg, 0], bent: [30deg, 60deg]}\n");
  }

  ProgramResult verify(const Words& more = {}, const std::string& suite = "arm.yaml") {
    return run_program(chainreel::with(Words{"verify", suite}, more), {.folder = folder_.path().string()});
  }
  // The results as JSON, whatever the exit code.
  Json results(const Words& more = {}, const std::string& suite = "arm.yaml") {
    const ProgramResult result = verify(chainreel::with(more, Words{"--json"}), suite);
    const Json json = parse_json(result.out);
    if (!json.is_object()) ADD_FAILURE() << result.err;
    return json;
  }
  void accept_all(const std::string& suite = "arm.yaml") {
    const ProgramResult result = verify({"--missing", "write"}, suite);
    ASSERT_EQ(result.status, 0) << result.out << result.err;
  }
  void write(const std::string& name, const std::string& text) { folder_.write(name, text); }
  void replace(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_whole_file(folder_.path() / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(file, text.replace(at, from.size(), to));
  }
  std::map<std::string, std::string> baselines(const std::string& name = "arm") const {
    std::map<std::string, std::string> files;
    const std::filesystem::path root = folder_.path() / (name + ".baselines");
    if (!std::filesystem::exists(root)) return files;
    for (const std::filesystem::directory_entry& entry : std::filesystem::recursive_directory_iterator(root))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(root).string()] = read_whole_file(entry.path());
    return files;
  }
  static Json picture(const Json& json, const std::string& name) {
    for (const Json& one : json["pictures"])
      if (one["name"] == name) return one;
    ADD_FAILURE() << "no picture " << name << " in " << json.dump(1);
    return Json::object();
  }
  static std::string words(const Json& json, const std::string& name) { return picture(json, name)["words"].dump(); }

  TemporaryFolder folder_;
};

}  // namespace chainreel
