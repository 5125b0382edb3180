#include "scene/yaml_document.hpp"

#include <yaml-cpp/eventhandler.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr std::uintmax_t kLargestFile = 1 << 20;  // bytes
constexpr int kDeepestNesting = 32;

// Walks the parser's events without building anything, so that hostile nesting is refused before it costs
// memory.
class Guard final : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { refuse_anchor(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    refuse_anchor(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail("aliases (*name) are not allowed: write the value out", mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    descend(mark, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    descend(mark, anchor);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void descend(const YAML::Mark& mark, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    if (++depth_ > kDeepestNesting)
      fail("nested deeper than " + std::to_string(kDeepestNesting) + " levels: a scene needs four", mark);
  }
  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) fail("anchors (&name) are not allowed: write the value out", mark);
  }
  [[noreturn]] void fail(const std::string& message, const YAML::Mark& mark) {
    throw Error(ExitCode::bad_input, message, {file_, mark.line + 1, mark.column + 1});
  }

  std::string file_;
  int depth_ = 0;
};

std::string read_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::exists(path, code)) throw Error(ExitCode::bad_input, "there is no such file", {path});
  if (!fs::is_regular_file(path, code)) throw Error(ExitCode::bad_input, "is not a file", {path});
  if (fs::file_size(path, code) > kLargestFile)
    throw Error(ExitCode::limit, "is larger than 1 MiB: a scene is some 25 lines", {path});
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error(ExitCode::bad_input, "cannot be read", {path});
  return text.str();
}

void refuse_duplicates(const YAML::Node& node, const std::string& file) {
  if (node.IsSequence())
    for (const YAML::Node& child : node) refuse_duplicates(child, file);
  if (!node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& pair : node) {
    const YAML::Mark mark = pair.first.Mark();
    if (!pair.first.IsScalar())
      throw Error(ExitCode::bad_input, "a key must be a plain word", {file, mark.line + 1, mark.column + 1});
    if (!seen.insert(pair.first.Scalar()).second)
      throw Error(ExitCode::bad_input,
                  "the key '" + pair.first.Scalar() + "' stands here twice: keep one of them",
                  {file, mark.line + 1, mark.column + 1});
    refuse_duplicates(pair.second, file);
  }
}

std::string name_of(const Override& one) {
  return "--set " + one.key + "=" + one.value;
}

// Parses one whole document of text; `where` names it in errors.
YAML::Node parse(const std::string& text, const std::string& where) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Guard guard(where);
    parser.HandleNextDocument(guard);
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) throw Error(ExitCode::bad_input, "holds more than one YAML document", {where});
    const YAML::Node root = documents.empty() ? YAML::Node() : documents.front();
    refuse_duplicates(root, where);
    return root;
  } catch (const YAML::Exception& error) {
    throw Error(ExitCode::bad_input, "is not valid YAML: " + error.msg,
                {where, error.mark.line + 1, error.mark.column + 1});
  }
}

// The element that a part of a key names: an index from 1 in lists, a key elsewhere.
YAML::Node child_of(YAML::Node node, const std::string& part, const Override& one) {
  if (node.IsMap()) return node[part];
  if (!node.IsSequence())
    throw Error(ExitCode::usage, "'" + part + "' is sought in a value that has no parts", {name_of(one)});
  const std::optional<double> index = parse_number(part);
  if (!index || *index < 1 || *index > double(node.size()) || *index != double(std::size_t(*index)))
    throw Error(ExitCode::usage, "'" + part + "' is no index from 1 to " + std::to_string(node.size()),
                {name_of(one)});
  return node[std::size_t(*index) - 1];
}

// Puts the value where the rest of the dotted key leads; mappings that are not there yet are made.
void apply(YAML::Node node, const std::string& key, const Override& one) {
  const std::size_t dot = key.find('.');
  YAML::Node child = child_of(node, key.substr(0, dot), one);
  if (dot == std::string::npos) {
    child = parse(one.value, name_of(one));
    return;
  }
  if (!child.IsDefined() || child.IsNull()) child = YAML::Node(YAML::NodeType::Map);
  apply(child, key.substr(dot + 1), one);
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ExitCode::usage, "--set takes key=value, for example --set duration=2; not '" + text + "'");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Place YamlDocument::place_of(const YAML::Node& node, const std::string& key) const {
  for (auto one = overrides.rbegin(); one != overrides.rend(); ++one) {
    const std::string& set = one->key;
    if (key == set || (key.size() > set.size() && key.starts_with(set) && key[set.size()] == '.'))
      return {name_of(*one), 0, 0};
  }
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? Place{file, 0, 0} : Place{file, mark.line + 1, mark.column + 1};
}

YamlDocument load_yaml(const std::string& path, const std::vector<Override>& overrides) {
  YamlDocument document{parse(read_text(path), path), path, overrides};
  if (!document.root.IsMap())
    throw Error(ExitCode::bad_input,
                "holds no scene: write `model: ...` and what else it needs, or see `chainreel init`", {path});
  for (const Override& one : overrides) apply(document.root, one.key, one);
  return document;
}

}  // namespace chainreel
