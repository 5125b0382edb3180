// The reference: pages that are made of the tables and registries which drive the program. `chainreel help TOPIC` prints
// them; assets/guide holds the same texts.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/cli/command_line.hpp"
#include "core/names.hpp"
#include "integrate/method.hpp"

namespace chainreel {

struct GuidePage {
  std::string topic;  // "scene"; the file is scene.md
  std::string about;  // half a sentence
  std::function<std::string()> text;
};

// `app` must outlive them.
std::vector<GuidePage> guide_pages(const CommandLine& app);

// --- the pages: reference_scene.cpp
std::string scene_page();
std::string constraints_page();
std::string layers_page();
std::string formulas_page();
// What a formula may hold: each name is one.
std::span<const Name> formula_notation();
// --- reference_runs.cpp
std::string methods_page();
std::string expressions_page();
std::string outputs_page();
std::string exit_codes_page();
// --- reference_symbols.cpp
std::string symbols_page();
// --- reference_json.cpp
std::string json_page();

// Keys between commas that are told together, and what they say.
struct JsonKey {
  std::string names, says;
};
struct JsonReport {
  std::string command;
  std::vector<JsonKey> keys;  // on top of what it prints
};
const std::vector<JsonReport>& json_reports();
const std::vector<JsonKey>& run_keys();
const std::vector<JsonKey>& film_keys();

// "12-30", "4".
std::string order_words(const Method& method);
// What the method moves: "q, qd".
std::string state_words(const Method& method);
// "0 good, 1 a comparison failed, ..".
std::string exit_code_words();

// Markdown that reads well in a terminal, too.

// A table whose columns are as wide as their longest cell; the first row is its head. `|` in cells is escaped.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);
std::string code(const std::string& text);                                // `text`, "" of nothing
std::string code_block(const std::string& language, const std::string& text);

}  // namespace chainreel
