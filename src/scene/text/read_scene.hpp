// A scene file, read and checked as far as that can be done without its model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chainreel {

// Who names the methods that run: the scene, or a command that has several of its own. For those a scene may say `step`,
// `tolerance` and `order` and name no method.
enum class MethodsOf { scene, command };

// `overrides` are texts `key=value` of the command line. Throws Error with every problem of the file.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {}, MethodsOf methods = MethodsOf::scene);

// The same of a text, YAML or JSON: `file` is what errors call it, and its paths start in the folder of that name.
Scene read_scene_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides = {});

struct YamlDocument;

// A scene file that is read again and again with other values of the same keys, as for the cells of a map: its text is
// parsed once. For one thread at a time.
class SceneFile {
 public:
  explicit SceneFile(const std::string& path);
  ~SceneFile();

  Scene read(const std::vector<std::string>& overrides);

 private:
  std::string path_;
  std::unique_ptr<YamlDocument> document_;
  int reads_ = 0;
};

// A model file as a scene that names it and leaves all else to defaults and overrides, whose paths are relative to the
// model's folder. Throws Error as above.
Scene read_model_scene(const std::string& model, const std::vector<std::string>& overrides = {});

}  // namespace chainreel
