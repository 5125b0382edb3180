#include "scene/yaml_document.hpp"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "core/data_folder.hpp"
#include "core/format.hpp"
#include "core/input_file.hpp"
#include "scene/yaml_aliases.hpp"

namespace chainreel {
namespace {

constexpr std::uintmax_t kLargestFile = 1 << 20;  // bytes

// Walks the parser's events without building anything, so that hostile nesting is refused before it costs
// memory.
class Guard final : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& file) : file_(file) {}

  // Before a comma that opens a document the library finds empty documents without end: the second is refused.
  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1)
      fail("a second YAML document begins here: keep one, without `---` and with no line that begins with a comma",
           mark);
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string& tag, YAML::anchor_t, const std::string& text) override {
    needs_expansion_ = needs_expansion_ || is_merge_key(tag, text);
  }
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override { needs_expansion_ = true; }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnMapEnd() override { --depth_; }

  bool needs_expansion() const { return needs_expansion_; }

 private:
  void descend(const YAML::Mark& mark) {
    if (++depth_ > kDeepestNesting)
      fail("nested deeper than " + std::to_string(kDeepestNesting) + " levels: four are enough", mark);
  }
  [[noreturn]] void fail(const std::string& message, const YAML::Mark& mark) {
    throw Error(ExitCode::bad_input, message, {file_, mark.line + 1, mark.column + 1});
  }

  std::string file_;
  int depth_ = 0, documents_ = 0;
  bool needs_expansion_ = false;
};

std::string read_text(const std::string& path) {
  if (const std::string* text = standard_input_at(path)) return *text;
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::exists(path, code)) throw Error(ExitCode::bad_input, "there is no such file", {path});
  if (fs::is_directory(path, code) && !shipped_file(path + ".yaml").empty())
    throw Error(ExitCode::bad_input, "is a folder here: the scene of that name which comes with the program is " + path + ".yaml", {path});
  if (!fs::is_regular_file(path, code)) throw Error(ExitCode::bad_input, fs::is_directory(path, code) ? "is a folder, not a file" : "is not a file", {path});
  if (fs::file_size(path, code) > kLargestFile)
    throw Error(ExitCode::limit, "is larger than 1 MiB: some 25 lines are enough", {path});
  note_input(path);
  std::ifstream stream(path, std::ios::binary);
  // Not through a stream of text, which takes want of memory for the file's end.
  std::string text;
  if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad()) throw Error(ExitCode::bad_input, "cannot be read", {path});
  return text;
}

// Of a node whose line counts in a text with aliases written out.
YAML::Mark true_mark(const YAML::Mark& mark, const std::vector<YAML::Mark>& marks) {
  return !mark.is_null() && std::size_t(mark.line) < marks.size() ? marks[std::size_t(mark.line)] : mark;
}

// What was read, and where the lines of the text it was read from stand in the file, if that is another text.
struct Parsed {
  YAML::Node root;
  std::vector<YAML::Mark> marks{};

  Place place_of(const YAML::Node& node, const std::string& file) const {
    const YAML::Mark mark = true_mark(node.Mark(), marks);
    return {file, mark.line + 1, mark.column + 1};
  }
};

void refuse_duplicates(const Parsed& parsed, const YAML::Node& node, const std::string& file) {
  if (node.IsSequence())
    for (const YAML::Node& child : node) refuse_duplicates(parsed, child, file);
  if (!node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& pair : node) {
    const Place place = parsed.place_of(pair.first, file);
    if (!pair.first.IsScalar()) throw Error(ExitCode::bad_input, "a key must be a plain word", place);
    if (!seen.insert(pair.first.Scalar()).second)
      throw Error(ExitCode::bad_input, "the key '" + pair.first.Scalar() + "' stands here twice: keep one of them", place);
    refuse_duplicates(parsed, pair.second, file);
  }
}

// Parses one whole document of text; `where` names it in errors.
Parsed parse(const std::string& text, const std::string& where) {
  if (text.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input, "is no text, as scenes are; `chainreel extract` finds the scene that a film or picture remembers", {where});
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Guard guard(where);
    while (parser.HandleNextDocument(guard)) {
    }
    Parsed parsed;
    if (guard.needs_expansion()) {
      ExpandedYaml expanded = expand_aliases(text, where);
      parsed = {YAML::Load(expanded.text), std::move(expanded.marks)};
    } else {
      parsed.root = YAML::Load(text);
    }
    refuse_duplicates(parsed, parsed.root, where);
    return parsed;
  } catch (const YAML::Exception& error) {
    const bool is_second_colon = error.msg.find("illegal map value") != std::string::npos;
    throw Error(ExitCode::bad_input, "is not valid YAML: " + error.msg + (is_second_colon ? ": a text that holds \": \" is written in quotes" : ""),
                {where, error.mark.line + 1, error.mark.column + 1});
  }
}

// A value for a dotted key, and who is to blame where it cannot be put there.
struct Change {
  std::string key;
  YAML::Node value;
  Place place;
  ExitCode code = ExitCode::usage;

  [[noreturn]] void refuse_key(std::string why) const { throw Error(code, std::vector<Problem>{{std::move(why), place, true}}); }
};

// The element that a part of a key names: an index from 1 in lists, a key elsewhere.
YAML::Node child_of(YAML::Node node, const std::string& part, const Change& change) {
  if (node.IsMap()) return node[part];
  if (!node.IsSequence())
    change.refuse_key("'" + part + "' is sought in a value that has no parts" +
                      (change.key.starts_with("model.") ? ": a model's file is taken as it is; a load at its end is `payload.mass`; else take copies, like model=light.urdf,heavy.urdf, or write it in numbers, "
                                                          "model: {links: [0.5, 0.4], masses: [2, 1.5]}, whose masses are model.masses.2"
                                                        : ""));
  const std::optional<double> index = parse_number(part);
  if (!index || *index < 1 || *index > double(node.size()) || *index != double(std::size_t(*index)))
    change.refuse_key("'" + part + "' is no index from 1 to " + std::to_string(node.size()));
  return node[std::size_t(*index) - 1];
}

// Puts the value where the rest of the dotted key leads; mappings that are not there yet are made. `is_panel`: the node is one of
// `compare`, whose keys are laid over the page's: there a way that it does not begin itself stays whole, as one writes it.
void apply(YAML::Node node, const std::string& key, const Change& change, bool is_panel = false) {
  const std::size_t dot = key.find('.');
  const bool is_whole = dot != std::string::npos && node.IsMap() &&
                        (node[key].IsDefined() || (is_panel && !node[key.substr(0, dot)].IsDefined()));
  YAML::Node child = is_whole ? node[key] : child_of(node, key.substr(0, dot), change);
  if (dot == std::string::npos || is_whole) {
    child = change.value;
    return;
  }
  if (!child.IsDefined() || child.IsNull()) child = YAML::Node(YAML::NodeType::Map);
  const bool is_of_panels = change.key.starts_with("compare.") && key.size() == change.key.size() - std::string("compare.").size();
  apply(child, key.substr(dot + 1), change, is_of_panels);
}

// Takes the key away as if the file did not have it. Returns whether it was there.
bool take_away(YAML::Node node, const std::string& key, const Change& change) {
  const std::size_t dot = key.find('.');
  if (dot != std::string::npos) {
    if (!node.IsMap() && !node.IsSequence()) return false;
    YAML::Node child = child_of(node, key.substr(0, dot), change);
    return child.IsDefined() && take_away(child, key.substr(dot + 1), change);
  }
  if (node.IsSequence())
    throw Error(change.code, "an entry of a list cannot be left out: give the list anew", change.place);
  return node.IsMap() && node[key].IsDefined() && node.remove(key);
}

bool lies_below(const std::string& key, const std::string& other) {
  return key.size() > other.size() && key.starts_with(other) && key[other.size()] == '.';
}

// Notes which parts of the panel's value for `key` the command line has set.
void note_overrides(YamlDocument& panel, const std::string& prefix, const std::string& key) {
  const std::string full = prefix + key;
  for (const Override& one : panel.overrides) {
    const Place place{name_of(one), 0, 0};
    if (one.key == full || lies_below(full, one.key)) panel.origins.push_back({key, place});
    if (lies_below(one.key, full)) panel.origins.push_back({one.key.substr(prefix.size()), place});
  }
}

void collect_places(const YamlDocument& document, const YAML::Node& map, const std::string& prefix,
                    std::map<std::string, Place>& places) {
  for (const auto& pair : map) {
    const std::string key = prefix + pair.first.Scalar();
    places[key] = document.place_of(pair.first, key);
    if (pair.second.IsMap()) collect_places(document, pair.second, key + ".", places);
  }
}

}  // namespace

std::string name_of(const Override& one) {
  return "--set " + one.key + "=" + one.value;
}

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ExitCode::usage, "--set takes key=value, for example --set duration=2; not '" + text + "'");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::string in_one_line(std::string words) {
  if (words.find_first_of("\t\r\n") == std::string::npos) return words;
  const std::size_t last = words.find_last_not_of(" \t\r\n");
  words.resize(last == std::string::npos ? 0 : last + 1);
  for (char& c : words)
    if (c == '\t' || c == '\r' || c == '\n') c = ' ';
  return words;
}

Place YamlDocument::place_of(const YAML::Node& node, const std::string& key) const {
  const YAML::Mark mark = true_mark(node.Mark(), marks);
  const Place here = mark.is_null() ? Place{file, 0, 0} : Place{file, mark.line + 1, mark.column + 1};
  if (const Origin* one = origin_of(key); one != nullptr && (one->key == key || one->command_line)) return one->place;
  return here;
}

const Origin* YamlDocument::origin_of(const std::string& key) const {
  const auto one = std::find_if(origins.rbegin(), origins.rend(),
                                [&](const Origin& origin) { return key == origin.key || lies_below(key, origin.key); });
  return one == origins.rend() ? nullptr : &*one;
}

bool YamlDocument::is_of_command_line(const std::string& key) const {
  const Origin* one = origin_of(key);
  return one != nullptr && one->command_line;
}

namespace {

// The dotted paths of what a value lists, or the key alone.
void add_leaves(const std::string& key, const YAML::Node& value, std::vector<std::string>& leaves) {
  if ((!value.IsMap() && !value.IsSequence()) || value.size() == 0) return leaves.push_back(key);
  std::size_t index = 0;
  for (const auto& one : value) {
    ++index;
    if (value.IsMap())
      add_leaves(key + "." + one.first.Scalar(), one.second, leaves);
    else
      add_leaves(key + "." + std::to_string(index), one, leaves);
  }
}

}  // namespace

bool YamlDocument::holds(const Override& one) const {
  std::vector<std::string> leaves;
  try {
    add_leaves(one.key, YAML::Load(one.value), leaves);
  } catch (const YAML::Exception&) {
    leaves = {one.key};
  }
  return std::any_of(leaves.begin(), leaves.end(), [&](const std::string& leaf) {
    const Origin* origin = origin_of(leaf);
    return origin != nullptr && origin->place.file == name_of(one);
  });
}

std::map<std::string, Place> YamlDocument::places() const {
  std::map<std::string, Place> places;
  collect_places(*this, root, "", places);
  return places;
}

YamlDocument yaml_document_of(const std::string& text, const std::string& path,
                              const std::vector<Override>& overrides, const std::string& lacking) {
  Parsed parsed = parse(text, path);
  YamlDocument document{parsed.root, path, text, overrides, {}, false, std::move(parsed.marks)};
  if (!document.root.IsMap()) throw Error(ExitCode::bad_input, lacking, {path});
  replace_overrides(document, overrides);
  return document;
}

void replace_overrides(YamlDocument& document, const std::vector<Override>& overrides) {
  document.overrides = overrides;
  document.origins.clear();
  for (const Override& one : overrides) {
    const Place place{name_of(one), 0, 0};
    if (one.value.find_first_not_of(' ') == std::string::npos) {
      if (take_away(document.root, one.key, {one.key, {}, place})) continue;
      // It was not there: null, so that a key that nobody knows is told.
    }
    apply(document.root, one.key, {one.key, parse(one.value, name_of(one)).root, place});
    document.origins.push_back({one.key, place});
  }
}

YamlDocument load_yaml(const std::string& path, const std::vector<Override>& overrides, const std::string& lacking) {
  return yaml_document_of(read_text(path), path, overrides, lacking);
}

YamlDocument panel_document(const YamlDocument& whole, std::size_t index) {
  // Read anew: nodes are shared, and a change in one panel must not reach the others.
  YamlDocument panel = yaml_document_of(whole.text, whole.file, whole.overrides);
  const YAML::Node changes = panel.root["compare"][index];
  panel.is_panel = true;
  panel.is_for_methods = whole.is_for_methods;
  for (const char* key : kKeysOfPage) panel.root.remove(key);
  // The first panel's events decide when the film is slow or stands still; others need not have them.
  if (index > 0)
    for (const char* key : {"slow_motion", "annotate"}) panel.root.remove(key);
  const std::string prefix = "compare." + std::to_string(index + 1) + ".";
  for (const auto& pair : changes) {
    const std::string& key = pair.first.Scalar();
    const YAML::Mark mark = true_mark(pair.first.Mark(), panel.marks);
    const Place place{panel.file, mark.line + 1, mark.column + 1};
    if (key.find('.') == std::string::npos) {
      panel.root.remove(key);
      panel.root.force_insert(pair.first, pair.second);
      std::erase_if(panel.origins,
                    [&](const Origin& one) { return one.key == key || lies_below(one.key, key); });
    } else {
      apply(panel.root, key, {key, pair.second, place, ExitCode::bad_input});
      panel.origins.push_back({key, place, false});
    }
    note_overrides(panel, prefix, key);
  }
  const YAML::Node motion = changes["motion"];
  const auto says = [&](const std::string& key) {
    return std::any_of(changes.begin(), changes.end(), [&](const auto& pair) { return pair.first.Scalar() == key || lies_below(pair.first.Scalar(), key); });
  };
  if (motion.IsDefined() && !motion.IsNull())
    for (const char* key : kKeysOfRuns)
      if (!says(key)) panel.root.remove(key);
  return panel;
}

}  // namespace chainreel
