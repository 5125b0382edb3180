// Scenes written by a test, beside a model that is never read.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/text/read_scene.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {

class WrittenScenes : public testing::Test {
 protected:
  WrittenScenes() { folder_.write("rr.urdf", "<robot/>"); }

  Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_scene(folder_.write("one.yaml", "model: rr.urdf\n" + text), overrides);
  }

  // The text of the error, or "" where the scene was read.
  std::string error(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }

  TemporaryFolder folder_;
};

}  // namespace chainreel
