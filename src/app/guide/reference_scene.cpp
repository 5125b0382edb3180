// Pages made of the table of keys.
#include <algorithm>
#include <cctype>
#include <set>

#include "app/guide/reference.hpp"
#include "core/format.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {
namespace {

std::string words_text(std::span<const Name> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + code(words[i].name);
  return text;
}

std::string value_cell(const KeyText& text);

// Told in the row of a table: nothing hangs below it.
bool is_short(const KeyText& text) {
  if (text.form == KeyForm::list) return is_short(text.parts[0]) && text.parts[0].form != KeyForm::word;
  if (text.form == KeyForm::either) return std::all_of(text.parts.begin(), text.parts.end(), is_short);
  return text.form != KeyForm::record;
}

// What may be written as the value, in a few words.
std::string value_words(const KeyText& text) {
  switch (text.form) {
    case KeyForm::number:
      return "number";
    case KeyForm::whole:
      return "whole number";
    case KeyForm::truth:
      return "`true` or `false`";
    case KeyForm::text:
      return "text";
    case KeyForm::path:
      return "path";
    case KeyForm::word:
      return words_text(text.words);
    case KeyForm::rate:
      return "rate";
    case KeyForm::accuracy:
      return "number and unit";
    case KeyForm::expression:
      return "expression";
    case KeyForm::list:
      if (text.parts[0].form == KeyForm::list && is_short(text)) return "list of lists" + value_words(text.parts[0]).substr(4);
      return is_short(text) ? "list of " + value_cell(text.parts[0]) + (value_cell(text.parts[0]).ends_with("`") ? "" : "s") : "list, see below";
    case KeyForm::mapping:
      if (text.parts[0].form == KeyForm::either && !is_short(text)) return "names, each with a text, or keys";
      return is_short(text.parts[0]) ? "names, each with a " + value_words(text.parts[0]) : "names, each with what is said below";
    case KeyForm::record:
      return "see below";
    case KeyForm::either:
      break;
  }
  if (!is_short(text)) return "see below";
  std::string words;
  for (const KeyText& part : text.parts) words += (words.empty() ? "" : ", or ") + value_cell(part);
  return words;
}

// "number, s", "number, above 0 s".
std::string value_cell(const KeyText& text) {
  std::string cell = value_words(text);
  const std::string range = range_text(text.range, text.unit);
  if (!text.unit.empty() && !range.ends_with(text.unit)) cell += ", " + text.unit;
  return cell + (range.empty() ? "" : ", " + range);
}

std::string default_cell(const SceneKey& key) {
  if (key.is_required) return "needed";
  if (!key.absent.empty()) return key.absent;
  return code(key.text(key, Scene{}));
}

// What hangs below a key, as a list in a list. Keys that stand there a second time are not told again.
class Tree {
 public:
  void add(const KeyText& text, int depth) {
    if (is_short(text)) return line(text, depth, value_cell(text));
    if (text.form == KeyForm::list) {
      line(text, depth, "a list, each entry");
      return add(text.parts[0], depth + 1);
    }
    if (text.form == KeyForm::either) {
      line(text, depth, "one of");
      for (const KeyText& part : text.parts) add(part, depth + 1);
      return;
    }
    std::string names;
    for (const KeyText& part : text.parts) names += part.name + " ";
    const bool is_new = names.empty() || told_.insert(names).second;
    line(text, depth, is_new ? "keys" : "the same keys");
    if (!is_new) return;
    for (const KeyText& part : text.parts) add(part, depth + 1);
  }
  const std::string& text() const { return text_; }

 private:
  void line(const KeyText& text, int depth, const std::string& value) {
    text_ += std::string(std::size_t(2 * depth), ' ') + "- ";
    if (!text.name.empty()) text_ += code(text.name) + (text.is_required ? " (needed): " : ": ");
    text_ += value + (text.help.empty() ? "" : ": " + text.help) + "\n";
  }

  std::string text_;
  std::set<std::string> told_;
};

std::string meanings_of(const SceneKey& key) {
  std::string text;
  for (const Name& word : key.words) text += "- " + code(word.name) + ": " + word.meaning + "\n";
  return text;
}

std::vector<std::string> chapters() {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys())
    if (names.empty() || names.back() != key.chapter) names.push_back(key.chapter);
  return names;
}

std::string chapter_text(const std::string& chapter) {
  std::vector<std::vector<std::string>> table{{"key", "value", "left out", "what it is"}};
  std::string details, examples;
  for (const SceneKey& key : scene_keys()) {
    if (key.chapter != chapter) continue;
    if (!key.example.empty()) examples += key.example + "\n";
    if (key.is_section) continue;
    const std::string where = key.of == KeyOf::page ? "" : " *";
    table.push_back({code(key.name) + where, value_cell(key), default_cell(key), key.help});
    if (!key.words.empty())
      details += "\n" + code(key.name) + ":\n\n" + meanings_of(key);
    else if (key.name == "draw")
      details += "\nThe layers of " + code(key.name) + " are on the page `layers`.\n";
    else if (key.name == "constraints")
      details += "\nThe kinds of " + code(key.name) + " are on the page `constraints`.\n";
    else if (!is_short(key)) {
      Tree tree;
      tree.add(key, 0);
      details += "\n" + tree.text();
    }
  }
  return "\n## " + chapter + "\n\n" + markdown_table(table) + details +
         (examples.empty() ? "" : "\n" + code_block("yaml", examples));
}

}  // namespace

std::string scene_page() {
  std::string text =
      "# Keys of a scene\n\n"
      "A scene is a YAML file. Each key may also be given on the command line: `--set video.width=640`; some have flags of\n"
      "their own; `--set tolerance=` takes a key away, and `--set method=rk4` those of step, tolerance, order and accuracy that do\n"
      "not go with rk4; `--set start.q.2=90deg` sets one entry of a list, counted from 1, of one that was left out beside the\n"
      "defaults of the others; words (`title`) are taken as they stand. Numbers are in SI units and radians, or constant\n"
      "expressions: `90deg`, `pi/2`, `1e-3`. Paths are relative\n"
      "to the scene file. A key with * may differ from panel to panel of a comparison; the others belong to the whole\n"
      "picture. `chainreel check SCENE` prints a scene with every key; `chainreel schema` prints a JSON Schema for editors.\n";
  for (const std::string& chapter : chapters()) text += chapter_text(chapter);
  return text;
}

std::string constraints_page() {
  std::string text =
      "# Constraints\n\n"
      "A URDF knows trees alone; `constraints:` is a list of what ties the mechanism further. Two numbers lie in the plane of\n"
      "motion, three are world x y z. The equations tau = M qdd + nle + J_c^T lambda are solved where rows repeat each other,\n"
      "too: lambda is what the robot presses on its ties with, along a row's direction. That of a line in the plane is the normal to the\n"
      "left of `direction` (for [1, 0] it is +y), of a plane its `normal`, of places the axes. A start that names some joints alone,\n"
      "`start: {q: {crank_joint: 60deg}, qd: {crank_joint: 6}}`, lets the others follow, put together in the same way all round; a joint named behind\n"
      "those that are free says about where it is, for another way: `{crank_joint: 60deg, crank_pin: -40deg}`. One that is a little beside is moved, and that is\n"
      "said; one out of reach is refused with the distance.\n";
  for (const KeyText& alternative : find_key("constraints")->parts[0].parts) {
    const KeyText& kind = alternative.parts[0];
    text += "\n## " + kind.name + "\n\n" + static_cast<char>(std::toupper(kind.help[0])) + kind.help.substr(1) + ".\n\n";
    std::vector<std::vector<std::string>> table{{"key", "value", "what it is"}};
    for (const KeyText& part : kind.parts) {
      table.push_back({code(part.name) + (part.is_required ? "" : " (may be left out)"), value_cell(part), part.help});
    }
    text += markdown_table(table) + "\n" + code_block("yaml", "constraints: [" + kind.example + "]");
  }
  text += chapter_text(find_key("constraints")->chapter);
  return text;
}

std::string layers_page() {
  std::vector<std::vector<std::string>> table{{"layer", "shows"}};
  for (const Name& layer : layer_names()) table.push_back({code(layer.name), layer.meaning});
  const SceneKey& draw = *find_key("draw");
  return "# Layers of a picture\n\n"
         "`draw:` names what is shown. A list replaces the default one, " +
         code(draw.text(draw, Scene{})) +
         ".\nEntries `+name` and `-name` edit it. Layers of the default list draw nothing where a scene has nothing of theirs, so that\n"
         "every scene shows its cause: torques that act, springs, constraints, gravity. Panels of `compare:` are small, and have\n"
         "neither `target` nor `constraint_force` by default.\n\n"
         "Vectors of one kind share one scale over the whole clip, which is printed whenever they are shown. No single peak decides\n"
         "on it: 95 % of them are no larger than an arrow of 0.2 of the picture's height or an arc of 240 degrees. What is more than\n"
         "1.25 times that is cut, and has a break in its shaft. A torque that shrinks to nothing shrinks to a dot; one that has rested\n"
         "for 0.3 s has a ring.\n\n"
         "A torque is drawn as a spring or a damper where its own expression says so: `-k * (q1 - a) - d * qd1` with numbers for\n"
         "k, a and d, also of a slider's `y_G`. The spring then stands for its arrow; a damper alone has both, and\n"
         "the arc of `8 - qd1`, beside its damper, is the whole torque.\n\n" +
         markdown_table(table) + "\n" + code_block("yaml", draw.example) +
         "\nHow `ellipse` reads the effective mass:\n\n" + meanings_of(*find_key("ellipse.reading")) +
         "\n" + code_block("yaml", find_key("ellipse")->example);
}

std::span<const Name> formula_notation() {
  static constexpr Name rows[] = {
      {"q1 x_G x_{rel, 2}", "letters, with an index: digits behind them, or what `_` lowers"},
      {"tau theta Lambda", "Greek letters by their names"},
      {"qd thetadd dot{x} ddot{x}", "time derivatives"},
      {"J^T J^-1 e^{-2 t}", "what `^` raises; a single T is the transpose"},
      {"M J Lambda bold{C}", "bold: the first three by themselves, beside M also C, D and K, and what stands in `bold{..}`"},
      {"frac{1}{2} m v^2", "a fraction"},
      {"sqrt{k/m}", "a root"},
      {"col{x; y} mat{a, b; c, d}", "a column, and a matrix row by row"},
      {"hat{q} bar{q}", "a hat, a bar"},
      {"2*a + b <= c", "signs; `*` is a dot between letters and nothing behind a number"},
      {"sin(q1) log(x) 3.5 N m", "functions, numbers and units, upright"},
      {"\"peak\" x", "words in quotes, as they stand"},
      {"\\tau = M(q)\\ddot{q} + \\frac{1}{2}\\mathbf{C}", "the same as LaTeX has it"}};
  return rows;
}

std::string formulas_page() {
  std::vector<std::vector<std::string>> table{{"notation", "what it is"}};
  for (const Name& one : formula_notation()) table.push_back({code(one.name), one.meaning});
  return "# Formulas in words\n\n"
         "Titles, the words of `annotate:` and titles of plots may hold formulas between dollar signs, in titles of one line. A dollar sign without a partner is\n"
         "one, as is `\\$`. What cannot be read as a formula is refused.\n\n" +
         markdown_table(table) + "\n" +
         code_block("yaml", "title: \"$M(q) qdd + nle(q, qd) = tau$, with $tau_1 = 5 sin(2 t)$\"");
}

}  // namespace chainreel
