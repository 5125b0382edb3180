#include "app/gallery_audit.hpp"

#include <algorithm>
#include <functional>

#include "core/format.hpp"

namespace chainreel {
namespace {

constexpr int kErrorDigits = 2;

std::string number_text(const Json& run, const char* key, int digits, const char* unit) {
  if (!run.contains(key) || !run[key].is_number()) return "";
  return format_significant(run[key].get<double>(), digits) + unit;
}

std::string word(const Json& run, const char* key) {
  return run.contains(key) && run[key].is_string() ? run[key].get<std::string>() : "";
}

// Digit by digit, as whole numbers are.
std::string count_text(const Json& run, const char* key) {
  return run.contains(key) && run[key].is_number_integer() ? std::to_string(run[key].get<long>()) : "";
}

std::string energy_error(const Json& run) {
  const std::string error = number_text(run, "audit_error", kErrorDigits, " J");
  if (error.empty()) return "";
  const std::string scale = number_text(run, "largest_kinetic_energy", 3, " J");
  return scale.empty() ? error : error + " (kinetic energy up to " + scale + ")";
}

std::string method_words(const Json& run) {
  std::string text = word(run, "method");
  if (text.empty()) return "";
  const std::string order = count_text(run, "order"), tolerance = number_text(run, "tolerance", 3, "");
  const std::string step = number_text(run, "step", 6, " s");
  if (!order.empty()) text += ", order " + order;
  if (!tolerance.empty()) text += ", tolerance " + tolerance;
  if (!step.empty()) text += ", step " + step;
  return run.contains("auto") ? text + " (chosen automatically)" : text;
}

std::string status_words(const Json& run) {
  std::string text = word(run, "status");
  if (const std::string trouble = word(run, "trouble"); !trouble.empty()) text += ": " + trouble;
  return text;
}

std::string event_words(const Json& run) {
  if (!run.contains("events") || !run["events"].is_array()) return "";
  std::string text;
  for (const Json& event : run["events"]) {
    const std::string at = number_text(event, "t", 6, " s");
    if (!at.empty()) text += (text.empty() ? "" : "; ") + word(event, "name") + " at t = " + at;
  }
  return text;
}

std::string constraint_words(const Json& run) {
  if (!run.contains("constraint_error") || !run["constraint_error"].is_object()) return "";
  return number_text(run["constraint_error"], "position_error", kErrorDigits, " m");
}

struct Row {
  const char* name;
  std::function<std::string(const Json&)> value;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"Energy error", &energy_error},
      {"Method", &method_words},
      {"Steps", [](const Json& run) { return count_text(run, "steps"); }},
      {"Evaluations", [](const Json& run) { return count_text(run, "evaluations"); }},
      {"Ended", &status_words},
      {"Duration", [](const Json& run) { return number_text(run, "duration", 6, " s"); }},
      {"Events", &event_words},
      {"Distance from constraints", &constraint_words},
      {"Frames", [](const Json& run) { return count_text(run, "frames"); }},
      {"Model", [](const Json& run) { return word(run, "model"); }},
      {"Trajectory SHA-256", [](const Json& run) { return word(run, "trajectory_sha256"); }},
  };
  return all;
}

// Each with what all of them share.
std::vector<Json> runs_of(const Json& audit) {
  if (!audit.contains("panels") || !audit["panels"].is_array()) return {audit};
  std::vector<Json> runs;
  for (const Json& panel : audit["panels"]) {
    runs.push_back(audit);
    runs.back().erase("panels");
    if (panel.is_object()) runs.back().update(panel);
  }
  return runs;
}

}  // namespace

std::vector<AuditRow> audit_rows(const Json& audit) {
  const std::vector<Json> runs = runs_of(audit);
  std::vector<AuditRow> table;
  if (runs.size() > 1) {
    table.push_back({"", {}});
    for (const Json& run : runs) table.back().values.push_back(word(run, "title"));
  }
  for (const Row& row : rows()) {
    AuditRow filled{row.name, {}};
    for (const Json& run : runs) filled.values.push_back(row.value(run));
    if (std::any_of(filled.values.begin(), filled.values.end(),
                    [](const std::string& v) { return !v.empty(); }))
      table.push_back(std::move(filled));
  }
  return table;
}

std::string audit_facts(const Json& audit, double film_seconds) {
  std::vector<std::string> facts;
  const std::vector<Json> runs = runs_of(audit.is_object() ? audit : Json::object());
  if (runs.size() > 1) facts.push_back(std::to_string(runs.size()) + " panels");
  if (runs.size() == 1) facts.push_back(word(runs.front(), "method"));
  facts.push_back(format_fixed(film_seconds, 2) + " s");
  const std::string frames = runs.empty() ? "" : count_text(runs.front(), "frames");
  if (!frames.empty()) facts.push_back(frames + " frames");
  const std::string error =
      runs.size() == 1 ? number_text(runs.front(), "audit_error", kErrorDigits, " J") : "";
  if (!error.empty()) facts.push_back("energy error " + error);
  std::string text;
  for (const std::string& fact : facts)
    if (!fact.empty()) text += (text.empty() ? "" : " \u00B7 ") + fact;
  return text;
}

}  // namespace chainreel
