// What differs between two records, in words.

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "app/report/driving_tables.hpp"
#include "app/verify/physics_record.hpp"
#include "core/change_words.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "model/model_difference.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/scene_difference.hpp"
#include "sim/trajectory_difference.hpp"

namespace chainreel {
namespace {

std::vector<double> numbers_of(const Json& json) {
  std::vector<double> numbers;
  numbers.reserve(json.size());
  for (const Json& one : json)
    numbers.push_back(one.is_null() ? std::numeric_limits<double>::quiet_NaN() : one.get<double>());
  return numbers;
}

std::vector<SampledNumber> sampled_numbers_of(const Json& json) {
  std::vector<SampledNumber> numbers;
  for (const Json& one : json)
    numbers.push_back({one.at(0).get<std::string>(), one.at(1).get<std::string>()});
  return numbers;
}

SampledTrajectory trajectory_of(const Json& json) {
  SampledTrajectory run;
  run.q_numbers = sampled_numbers_of(json.at("q_numbers"));
  run.qd_numbers = sampled_numbers_of(json.at("qd_numbers"));
  run.t = numbers_of(json.at("t"));
  run.q = numbers_of(json.at("q"));
  run.qd = numbers_of(json.at("qd"));
  if (run.q.size() != run.t.size() * run.q_numbers.size() ||
      run.qd.size() != run.t.size() * run.qd_numbers.size())
    throw Error(ExitCode::bad_input, "is no record of runs: its samples are incomplete");
  for (const Json& event : json.at("events"))
    run.events.push_back({event.at(0).get<std::string>(), event.at(1).get<double>()});
  run.status = json.at("status").get<std::string>();
  run.end_time = json.at("end_time").get<double>();
  return run;
}

std::string method_words(const Json& method) {
  std::string words = method.at("name").get<std::string>();
  if (const double step = method.at("step").get<double>(); step > 0)
    words += ", step " + format_shortest(step) + " s";
  if (method.contains("tolerance"))
    words += ", tolerance " + format_shortest(method["tolerance"].get<double>());
  if (method.contains("order")) words += ", order " + std::to_string(method["order"].get<int>());
  return words;
}

// Keys that a motion depends on; those of the whole picture but for its length do not act on it.
bool moves(const std::string& key) {
  const SceneKey* row = find_key(key);
  if (row == nullptr || row->name == "duration") return true;
  return row->of == KeyOf::panel && row->chapter != "The robot's looks" && row->name != "expect";
}

struct Changes {
  std::vector<std::string> causes;  // of other motions
  std::vector<std::string> looks;
};

// Another method has another step or tolerance, which is no second cause.
void join_method(std::vector<std::string>& causes) {
  const auto tells = [](const std::string& words, std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
      return words.starts_with(key + " ") || words.starts_with(key + ": ");
    });
  };
  const auto method = std::find_if(causes.begin(), causes.end(),
                                   [&](const std::string& words) { return tells(words, {"method"}); });
  if (method == causes.end()) return;
  std::vector<std::string> more;
  for (const std::string& words : causes)
    if (tells(words, {"step", "tolerance", "order", "accuracy"})) more.push_back(words);
  if (!more.empty()) *method += " (" + joined(more) + ")";
  std::erase_if(causes, [&](const std::string& words) {
    return std::find(more.begin(), more.end(), words) != more.end();
  });
}

// A start is brought onto the constraints, so that it moves with them and with the model: then it is no cause
// of its own.
void take_start_along(std::vector<std::string>& causes, std::vector<std::string>& consequences) {
  const auto starts = std::stable_partition(
      causes.begin(), causes.end(), [](const std::string& words) { return !words.starts_with("start."); });
  if (starts == causes.begin() || starts == causes.end()) return;
  consequences.push_back("the start on the constraints: " + joined({starts, causes.end()}));
  causes.erase(starts, causes.end());
}

void add_key_changes(const Json& before, const Json& after, Changes& changes) {
  const auto text = [](const Json& keys, const std::string& key) {
    return keys.contains(key) ? keys[key].get<std::string>() : std::string();
  };
  const auto add = [&](const std::string& key) {
    for (std::string& words : key_changes(key, text(before, key), text(after, key)))
      (moves(key) ? changes.causes : changes.looks).push_back(std::move(words));
  };
  for (const auto& [key, value] : after.items()) add(key);
  for (const auto& [key, value] : before.items())
    if (!after.contains(key)) add(key);
}

// A model's file under another name is told by what differs in it; how it was read, by the scene's keys.
void add_model_changes(const Json& before, const Json& after, const Json& keys, Changes& changes) {
  if (before == after) return;
  // What does not act on the run is no cause of another one.
  const bool limits_act = keys.value("limit", "") != to_string(LimitPolicy::report);
  const bool friction_acts = keys.value("friction", "") != "false";
  for (ModelDifference& one : differences(model_description_of(before), model_description_of(after))) {
    if (one.change == ModelChange::reading) continue;
    const bool acts = one.change == ModelChange::limit        ? limits_act
                      : one.change == ModelChange::resistance ? friction_acts
                                                              : one.change != ModelChange::looks;
    (acts ? changes.causes : changes.looks).push_back(std::move(one.words));
  }
}

// What happened otherwise, first in one sentence with its cause where there is but one.
std::vector<std::string> told(const TrajectoryDifference& difference, const Json& before, const Json& after,
                              Changes changes) {
  std::vector<std::string> sentences;
  std::string motion = freedom_words(difference);
  const bool has_other_bits = before.at("t") == after.at("t") && before.at("sha256") != after.at("sha256");
  if (motion.empty() && has_other_bits && changes.causes.empty() && difference.others.empty())
    motion = "the trajectory differs in its last digits, or between the samples that are kept";
  // A cause that leaves the motion as it is, like another force on a constraint, is not told by its round-off.
  const bool is_same = !motion.empty() && !changes.causes.empty() && is_rounding(difference);
  if (is_same) motion = "the motion is the same but for rounding: " + motion;
  if (motion.empty() || is_same || changes.causes.size() != 1) {
    sentences = std::move(changes.causes);
    if (!motion.empty()) sentences.push_back(std::move(motion));
  } else {
    sentences.push_back(motion + ": " + changes.causes.front());
  }
  sentences.insert(sentences.end(), difference.others.begin(), difference.others.end());
  sentences.insert(sentences.end(), changes.looks.begin(), changes.looks.end());
  return sentences;
}

std::vector<std::string> explain_panels(const Json& before, const Json& after, const Json& of_before,
                                        const Json& of_after) {
  Changes changes;
  add_key_changes(before.at("keys"), after.at("keys"), changes);
  // What is shown as it was recorded is driven by no other table.
  for (std::string& one : table_changes(before.at("tables"), after.at("tables"), after.at("keys").contains("motion") ? "motion" : "torque"))
    changes.causes.push_back(std::move(one));
  add_model_changes(of_before.at("models").at(before.at("model").get<std::size_t>()),
                    of_after.at("models").at(after.at("model").get<std::size_t>()), after.at("keys"),
                    changes);
  join_method(changes.causes);
  const std::string old = method_words(before.at("method")), now = method_words(after.at("method"));
  const Json &run_before = before.at("trajectory"), &run_after = after.at("trajectory");
  TrajectoryDifference difference;
  if (run_before != run_after)
    difference = difference_of(trajectory_of(run_before), trajectory_of(run_after));
  if (after.at("keys").contains("constraints")) take_start_along(changes.causes, difference.others);
  // Of another model or torque `auto` may take another method, which then is no cause of its own.
  if (const std::string chosen = "method chosen by auto: " + change_text(old, now);
      old != now && before.at("keys") == after.at("keys")) {
    if (changes.causes.empty())
      changes.causes.push_back(chosen);
    else
      difference.others.push_back(chosen);
  }
  return told(difference, run_before, run_after, std::move(changes));
}

// What all panels say is said once.
std::vector<std::string> joined_panels(const std::vector<std::vector<std::string>>& panels,
                                       const Json& titles) {
  std::vector<std::string> sentences;
  if (panels.empty()) return sentences;
  if (panels.size() == 1) return panels.front();
  const auto all_say = [&](const std::string& words) {
    return std::all_of(panels.begin(), panels.end(), [&](const std::vector<std::string>& panel) {
      return std::find(panel.begin(), panel.end(), words) != panel.end();
    });
  };
  for (const std::string& words : panels.front())
    if (all_say(words)) sentences.push_back(words);
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (const std::string& words : panels[i])
      if (!all_say(words))
        sentences.push_back("panel " + std::to_string(i + 1) + " (" +
                            titles.at(i).at("title").get<std::string>() + "): " + words);
  return sentences;
}

std::vector<std::string> explained(const Json& before, const Json& after) {
  const Json &old = before.at("panels"), &now = after.at("panels");
  std::vector<std::string> sentences;
  if (old.size() != now.size()) {
    sentences.push_back("compare: panels " +
                        change_text(std::to_string(old.size()), std::to_string(now.size())));
  } else {
    std::vector<std::vector<std::string>> panels;
    for (std::size_t i = 0; i < now.size(); ++i)
      panels.push_back(explain_panels(old[i], now[i], before, after));
    sentences = joined_panels(panels, now);
    for (std::size_t i = 0; now.size() > 1 && i < now.size(); ++i)
      if (old[i].at("title") != now[i].at("title"))
        sentences.push_back(
            "panel " + std::to_string(i + 1) + ": title " +
            change_text(old[i].at("title").get<std::string>(), now[i].at("title").get<std::string>()));
  }
  Changes page;
  add_key_changes(before.at("page"), after.at("page"), page);
  sentences.insert(sentences.end(), page.causes.begin(), page.causes.end());
  sentences.insert(sentences.end(), page.looks.begin(), page.looks.end());
  return sentences;
}

// What says how a motion is computed, not which.
constexpr std::array<std::string_view, 5> kKeysOfMethods = {"method", "step", "tolerance", "order", "accuracy"};

// Whether no key that a motion depends on is another.
bool looks_alone(const Json& before, const Json& after) {
  const auto is_kept = [](const Json& keys, const Json& others) {
    for (const auto& [key, value] : keys.items())
      if (moves(key) && others.value(key, Json()) != value) return false;
    return true;
  };
  return is_kept(before, after) && is_kept(after, before);
}

bool is_same_but_for_looks(const Json& before, const Json& after) {
  if (before == after) return true;
  const std::vector<ModelDifference> all = differences(model_description_of(before), model_description_of(after));
  return std::all_of(all.begin(), all.end(), [](const ModelDifference& one) { return one.change == ModelChange::looks; });
}

Json without_method(Json panel) {
  for (const std::string_view key : kKeysOfMethods) panel["keys"].erase(std::string(key));
  for (const char* own : {"method", "trajectory"}) panel.erase(own);
  return panel;
}

}  // namespace

bool is_same_motion(const Json& before, const Json& after) {
  constexpr double kOfRange = 1e-3;
  const Json &old = before.at("panels"), &now = after.at("panels");
  if (old.size() != now.size() || before.at("models") != after.at("models") || before.at("page") != after.at("page")) return false;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (without_method(old[i]) != without_method(now[i])) return false;
    if (!difference_of(trajectory_of(old[i].at("trajectory")), trajectory_of(now[i].at("trajectory")), kOfRange).empty()) return false;
  }
  return true;
}

bool differ_in_looks_alone(const Json& before, const Json& after) {
  if (!after.contains("models")) return is_same_but_for_looks(before, after);
  const Json &old = before.at("panels"), &now = after.at("panels");
  if (old.size() != now.size() || before.at("models").size() != after.at("models").size()) return false;
  if (!looks_alone(before.at("page"), after.at("page"))) return false;
  for (std::size_t i = 0; i < before.at("models").size(); ++i)
    if (!is_same_but_for_looks(before["models"][i], after["models"][i])) return false;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!looks_alone(old[i].at("keys"), now[i].at("keys"))) return false;
    for (const char* key : {"tables", "model", "method", "trajectory"})
      if (old[i].at(key) != now[i].at(key)) return false;
  }
  return true;
}

std::vector<std::string> explain_models(const Json& before, const Json& after) {
  std::vector<std::string> sentences;
  if (before == after) return sentences;
  for (ModelDifference& one : differences(model_description_of(before), model_description_of(after)))
    sentences.push_back(std::move(one.words));
  return sentences;
}

bool have_change(const Json& before, const Json& after, ModelChange change) {
  if (before == after) return false;
  if (!after.contains("models")) {
    const std::vector<ModelDifference> all = differences(model_description_of(before), model_description_of(after));
    return std::any_of(all.begin(), all.end(), [&](const ModelDifference& one) { return one.change == change; });
  }
  const Json &old = before.at("models"), &now = after.at("models");
  for (std::size_t i = 0; i < std::min(old.size(), now.size()); ++i)
    if (have_change(old[i], now[i], change)) return true;
  return false;
}

std::vector<std::string> explain_runs(const Json& before, const Json& after) {
  if (before == after) return {};
  try {
    return explained(before, after);
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "is no record of runs, or was changed by hand");
  }
}

std::vector<std::string> explain_poses(const std::vector<double>& before, const std::vector<double>& after,
                                       const std::vector<std::string>& coordinate_names, const Json& model) {
  if (before.size() != after.size())
    return {"pose: " + change_text(std::to_string(before.size()), std::to_string(after.size())) + " numbers"};
  const std::vector<DescribedCoordinate> coordinates =
      model.is_null() ? std::vector<DescribedCoordinate>{} : model_description_of(model).coordinates;
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] == after[i]) continue;
    const std::string name = i < coordinate_names.size() ? coordinate_names[i] : "q" + std::to_string(i + 1);
    const std::string unit = i < coordinates.size() ? coordinates[i].unit : "";
    if (unit != "rad") {
      changes.push_back(name + " " + change_text(before[i], after[i], unit));
      continue;
    }
    constexpr double kDegrees = 180 / std::numbers::pi;
    changes.push_back(name + " " + change_text(kDegrees * before[i], kDegrees * after[i], "deg"));
  }
  if (changes.empty()) return {};
  return {"pose: " + joined(changes)};
}

}  // namespace chainreel
