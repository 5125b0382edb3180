#include "scene/yaml_aliases.hpp"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

#include "core/error.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostValues = 20000;  // a scene has some 50; ten aliases of ten aliases pass this at the fifth line

struct Value {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text;  // of a scalar
  YAML::Mark mark;
  bool merges = false;        // a plain `<<`
  std::vector<Value> parts;   // of a map: key, value, key, value, ..
  std::size_t count = 1;      // of values in it, itself too
  int depth = 1;              // of lists and mappings in it
};

// Builds the tree with each alias in full.
class Unfolding final : public YAML::EventHandler {
 public:
  explicit Unfolding(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Value value;
    value.mark = mark;
    close(std::move(value), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& text) override {
    Value value;
    value.kind = Value::Kind::scalar;
    value.text = text;
    value.mark = mark;
    value.merges = is_merge_key(tag, text);
    close(std::move(value), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto anchored = anchored_.find(anchor);
    if (anchored == anchored_.end()) fail(ExitCode::bad_input, "an alias (*name) stands within its own anchor: it would have no end", mark);
    Value value = (count_ += anchored->second.count) > kMostValues ? too_much(mark) : anchored->second;
    if (!open_.empty() && is_key_next()) {
      if (value.kind != Value::Kind::scalar) fail(ExitCode::bad_input, "a key must be a plain word", mark);
      value.mark = mark;
    }
    if (int(open_.size()) + value.depth - 1 > kDeepestNesting) too_deep(mark);
    put(std::move(value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    open(Value::Kind::sequence, mark, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    open(Value::Kind::map, mark, anchor);
  }
  void OnMapEnd() override {
    open_.back().value.parts = merged(std::move(open_.back().value.parts));
    end();
  }

  const Value& root() const { return root_; }

 private:
  struct Open {
    Value value;
    YAML::anchor_t anchor;
  };

  [[noreturn]] void fail(ExitCode code, const std::string& message, const YAML::Mark& mark) const {
    throw Error(code, message, {file_, mark.line + 1, mark.column + 1});
  }
  [[noreturn]] Value too_much(const YAML::Mark& mark) const {
    fail(ExitCode::limit, "aliases (*name) unfold to more than " + std::to_string(kMostValues) + " values here: write fewer", mark);
  }
  [[noreturn]] void too_deep(const YAML::Mark& mark) const {
    fail(ExitCode::bad_input, "nested deeper than " + std::to_string(kDeepestNesting) + " levels: four are enough", mark);
  }
  bool is_key_next() const {
    return open_.back().value.kind == Value::Kind::map && open_.back().value.parts.size() % 2 == 0;
  }

  void open(Value::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (!open_.empty() && is_key_next()) fail(ExitCode::bad_input, "a key must be a plain word", mark);
    Value value;
    value.kind = kind;
    value.mark = mark;
    open_.push_back({std::move(value), anchor});
    if (int(open_.size()) > kDeepestNesting) too_deep(mark);
  }
  void end() {
    Open done = std::move(open_.back());
    open_.pop_back();
    done.value.count = 1;
    int deepest = 0;
    for (const Value& part : done.value.parts) {
      done.value.count += part.count;
      deepest = std::max(deepest, part.depth);
    }
    done.value.depth = 1 + deepest;
    close(std::move(done.value), done.anchor);
  }
  void close(Value value, YAML::anchor_t anchor) {
    if (++count_ > kMostValues) too_much(value.mark);
    if (anchor != YAML::NullAnchor) anchored_[anchor] = value;
    put(std::move(value));
  }
  void put(Value value) {
    if (open_.empty())
      root_ = std::move(value);
    else
      open_.back().value.parts.push_back(std::move(value));
  }

  // The keys of the mappings that `<<` names, in its place: those that stand beside it hold first, then the first of the mappings.
  std::vector<Value> merged(std::vector<Value> parts) const {
    const auto merge_key = [&](std::size_t i) { return parts[i].merges; };
    std::vector<std::string> known;
    bool any = false;
    for (std::size_t i = 0; i < parts.size(); i += 2) {
      if (!merge_key(i))
        known.push_back(parts[i].text);
      else if (std::exchange(any, true))
        fail(ExitCode::bad_input, "the key '<<' stands here twice: give it a list, like `<<: [*one, *other]`", parts[i].mark);
    }
    if (!any) return parts;
    std::vector<Value> result;
    const auto take = [&](Value& from) {
      if (from.kind != Value::Kind::map)
        fail(ExitCode::bad_input, "`<<` takes the alias of a mapping, like `<<: *common`, or a list of such", from.mark);
      for (std::size_t k = 0; k < from.parts.size(); k += 2) {
        if (std::find(known.begin(), known.end(), from.parts[k].text) != known.end()) continue;
        known.push_back(from.parts[k].text);
        result.push_back(std::move(from.parts[k]));
        result.push_back(std::move(from.parts[k + 1]));
      }
    };
    for (std::size_t i = 0; i < parts.size(); i += 2) {
      if (!merge_key(i)) {
        result.push_back(std::move(parts[i]));
        result.push_back(std::move(parts[i + 1]));
      } else if (parts[i + 1].kind == Value::Kind::sequence) {
        for (Value& one : parts[i + 1].parts) take(one);
      } else {
        take(parts[i + 1]);
      }
    }
    return result;
  }

  std::string file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Value> anchored_;
  Value root_;
  std::size_t count_ = 0;
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    char escape[8];
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      std::snprintf(escape, sizeof escape, "\\x%02x", unsigned(static_cast<unsigned char>(c)));
      result += escape;
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + "\"";
}

// In flow style, each value on a line of its own.
class Writing {
 public:
  void write(const Value& value) {
    out_.marks.push_back(value.mark);
    const bool is_map = value.kind == Value::Kind::map;
    switch (value.kind) {
      case Value::Kind::null: out_.text += "~"; break;
      case Value::Kind::scalar: out_.text += quoted(value.text); break;
      default:
        out_.text += is_map ? "{" : "[";
        for (std::size_t i = 0; i < value.parts.size(); ++i) {
          if (i > 0) out_.text += is_map && i % 2 == 1 ? ":" : ",";
          out_.text += "\n";
          write(value.parts[i]);
        }
        out_.text += is_map ? "}" : "]";
    }
  }
  ExpandedYaml take() { return std::move(out_); }

 private:
  ExpandedYaml out_;
};

}  // namespace

bool is_merge_key(const std::string& tag, const std::string& value) {
  return value == "<<" && tag != "!";  // quoted it is a key like any other
}

ExpandedYaml expand_aliases(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Unfolding unfolding(file);
  while (parser.HandleNextDocument(unfolding)) {
  }
  Writing writing;
  writing.write(unfolding.root());
  return writing.take();
}

}  // namespace chainreel
