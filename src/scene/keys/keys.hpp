// The keys of a scene: one table with a row a key. It drives reading, writing, `--set`, the flags of the command line,
// the titles of panels, the reference and the JSON Schema. To add a key of one number or word: its member in
// scene.hpp, or wherever it is used, and a row in keys.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/keys/key_text.hpp"
#include "scene/scene.hpp"

namespace chainreel {

class Fields;

enum class KeyOf {
  panel,  // each panel of a comparison may have its own
  page,   // of the whole picture
};
// Commands take flags by these groups.
enum class FlagGroup { none, output, size, look, page, view };
// What commands that are given a model in a scene's place make of a key.
enum class OfModel { no, mechanism, picture };

// A key, dotted below `start`, `parameters` and the like, and its value in one line of YAML.
struct SceneEntry {
  std::string key;
  std::string text;
  friend bool operator==(const SceneEntry&, const SceneEntry&) = default;
};

// `name` is the dotted path: "video.width". A row of form record is a mapping whose keys are the rows behind it.
struct SceneKey : KeyText {
  using Read = std::function<void(const SceneKey& key, Fields& fields, Scene& scene)>;
  using Write = std::function<void(const SceneKey& key, const Scene& scene, std::vector<SceneEntry>& entries)>;

  std::string chapter;  // of the reference
  KeyOf of = KeyOf::panel;
  FlagGroup flags = FlagGroup::none;
  std::string flag;      // "--theme"
  OfModel of_model = OfModel::no;
  bool is_seen_at_poses = false;  // of the mechanism, and seen in pictures of a pose, as a payload's disc is
  std::string absent;    // what holds where the key is left out, where that is no value of its own
  std::string hint;      // behind the message about a value out of range
  std::string infinity;  // the word for a number without end
  std::string caption;   // in titles of panels: "step @ s"; "": "name = @"
  bool is_captioned = true;

  bool is_section = false;
  bool takes_null = false;  // which says that the key is absent

  Read read;    // from the mapping that holds the key; of a section one value for all its leaves, none where it takes none
  Write write;  // adds nothing where the scene leaves it out
  std::function<std::string(const SceneKey& key, const Scene& scene)> text;  // the value in one line, "": absent
  bool (*means_something)(const Scene& scene) = nullptr;                     // null: it always does

  std::string leaf() const { return name.substr(name.rfind('.') + 1); }
  std::string section() const { return name.find('.') == std::string::npos ? "" : name.substr(0, name.find('.')); }
};

// In the order in which keys are read and written.
const std::vector<SceneKey>& scene_keys();

// The row of a dotted key, or of the mapping with names of one's own that holds it; null: there is none.
const SceneKey* find_key(const std::string& path);

// In a flag's help: "light or dark", "larger for small pictures, between 0.5 and 3".
std::string short_help(const SceneKey& key);

// Names without dots of what is `of_model` at most as far as `use`, sections by their members.
std::vector<std::string> keys_of_models(OfModel use);

// Keys of the whole picture, which no single panel of a comparison can have; sections by their name.
const std::vector<std::string>& page_keys();

// Names of all keys, however deep, whose value is a path; those below `packages` have names of their own.
const std::vector<std::string>& path_keys();

}  // namespace chainreel
