#include "draw/layers/torque_label.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <string_view>

#include "core/format.hpp"
#include "draw/layers/layer.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kZerosTold = 1;        // beside one torque
constexpr std::size_t kMostResistances = 4;  // joints whose damping is told one by one

std::string unit_of(const Chain& chain) {
  bool revolute = false, prismatic = false;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const JointKind kind = chain.bodies[b].joint.kind;
    revolute |= kind != JointKind::prismatic;
    prismatic |= kind != JointKind::revolute;  // a floating joint has forces and torques
  }
  if (revolute == prismatic) return "";
  return revolute ? " N m" : " N";
}

// Where the bracket that opens at `open` closes; the end where it does not.
std::size_t closing(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i;
  }
  return text.size();
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

// Behind the exponent that begins at `begin`: a bracket, or a sign and a word with the bracket that follows
// it.
std::size_t exponent_end(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (text[end] == '-' || text[end] == '+')) ++end;
  while (end < text.size() && is_word(text[end])) ++end;
  return end < text.size() && text[end] == '(' ? std::min(closing(text, end) + 1, text.size()) : end;
}

// As written, but for exponents: "2 ^ (t - 1)" is raised as a whole and its bracket falls away.
std::string entry_notation(const std::string& text) {
  std::string notation;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '^') {
      notation += text[i++];
      continue;
    }
    notation.erase(notation.find_last_not_of(' ') + 1);
    const std::size_t begin = std::min(text.find_first_not_of(' ', i + 1), text.size());
    const std::size_t end = exponent_end(text, begin);
    const bool bracketed = begin < end && text[begin] == '(' && text[end - 1] == ')';
    notation += "^{" + entry_notation(text.substr(begin + bracketed, end - begin - 2 * bracketed)) + "}";
    i = end;
  }
  return notation;
}

bool is_comparison(const std::string& text) {
  const std::size_t sign = text.find_first_of("<>=");
  if (sign == std::string::npos || sign == 0 || text[sign] == '=') return false;
  const std::size_t behind = sign + (text.compare(sign + 1, 1, "=") == 0 ? 2 : 1);
  return behind < text.size() && text.find_first_of("<>=", behind) == std::string::npos;
}

bool is_number_or_name(const std::string& text) {
  const std::size_t begin = text.starts_with('-') ? 1 : 0;
  return begin < text.size() && std::all_of(text.begin() + std::ptrdiff_t(begin), text.end(), is_word);
}

// The factors of a product that has no other sign at its top level, blanks around them gone; none where it is none.
std::vector<std::string> factors_of(const std::string& text) {
  std::vector<std::string> factors{""};
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth == 0 && c == '*')
      factors.emplace_back();
    else if (c != ' ' || depth > 0)
      factors.back() += c;
  }
  return factors;
}

// What stands in the brackets of a factor that is one comparison.
std::optional<std::string> condition_of(const std::string& factor) {
  if (factor.size() < 2 || factor.front() != '(' || closing(factor, 0) + 1 != factor.size()) return {};
  std::string inside = factor.substr(1, factor.size() - 2);
  if (inside.find_first_of("()") != std::string::npos || !is_comparison(inside)) return {};
  return inside;
}

// A comparison's sides, the smaller one first: "t >= 0" is 0 <= t.
struct Order {
  std::string smaller, sign, larger;
};
Order order_of(const std::string& condition) {
  const std::size_t at = condition.find_first_of("<>");
  const std::size_t behind = at + (condition.compare(at + 1, 1, "=") == 0 ? 2 : 1);
  Order order{trimmed(condition.substr(0, at)), condition.substr(at, behind - at), trimmed(condition.substr(behind))};
  if (order.sign.front() == '>') {
    std::swap(order.smaller, order.larger);
    order.sign.front() = '<';
  }
  return order;
}

// Two bounds of one thing as one says them, "0 <= t < 0.5"; otherwise both.
std::string both_of(const std::string& one, const std::string& other) {
  Order lower = order_of(one), upper = order_of(other);
  if (lower.smaller == upper.larger) std::swap(lower, upper);
  if (lower.larger == upper.smaller)
    return entry_notation(lower.smaller + " " + lower.sign + " " + lower.larger + " " + upper.sign + " " + upper.larger);
  return entry_notation(one) + "\" and \"" + entry_notation(other);
}

// "5 * (t < 0.5)" as one says it: 5 if t < 0.5 else 0; with two comparisons, too. Of other products nothing.
std::optional<std::string> conditional_notation(const std::string& text) {
  std::vector<std::string> conditions;
  std::string amount;
  for (const std::string& factor : factors_of(text)) {
    if (const std::optional<std::string> condition = condition_of(factor))
      conditions.push_back(*condition);
    else if (amount.empty() && is_number_or_name(factor))
      amount = factor;
    else
      return {};
  }
  if (amount.empty() || conditions.empty() || conditions.size() > 2) return {};
  return entry_notation(amount) + "\" if \"" + (conditions.size() == 1 ? entry_notation(conditions[0]) : both_of(conditions[0], conditions[1])) +
         "\" else \"0";
}

// The first entries and the last one, `shown` in all.
std::string list_of(const std::vector<std::string>& entries, std::size_t shown) {
  std::string list;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (shown < entries.size() && i + 1 == shown) {
      list += "\u2026, ";
      i = entries.size() - 1;
    }
    list += entries[i] + (i + 1 < entries.size() ? ", " : "");
  }
  return list;
}

}  // namespace

namespace {

// A function of the calling program by its name, as it stands there, where that is one which formulas can hold.
std::string function_notation(const OwnTorque& function) {
  std::string name = function.name;
  name.erase(0, std::min(name.find_first_not_of('_'), name.size()));
  const auto is_plain = [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '_'); };
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) || !std::all_of(name.begin(), name.end(), is_plain))
    return "tau(t, q, qd)";
  return "\"" + name + "\"(t, q, qd)";
}

}  // namespace

std::string control_notation(const Control& control) {
  std::string sum;
  const auto add = [&](bool given, const std::string& term) {
    if (!given) return;
    if (sum.empty())
      sum = term;
    else
      sum += term.starts_with('-') ? " - " + term.substr(1) : " + " + term;
  };
  add(control.gravity_compensation, "tau_g(q)");
  add(!control.csv.empty() || !control.inverse_of.empty(), "tau(t)");
  add(control.pd.has_value(), "PD");
  add(control.computed_torque.has_value(), "computed torque");
  add(control.task.has_value(), "J^T F");
  if (control.function) add(true, function_notation(*control.function));
  std::vector<std::string> plus;
  for (const Entry& entry : control.plus) plus.push_back(conditional_notation(entry.text).value_or(entry_notation(entry.text)));
  const bool adds = std::any_of(plus.begin(), plus.end(), [](const std::string& one) { return one != "0"; });
  if (adds) add(true, plus.size() == 1 ? plus.front() : "(" + list_of(plus, plus.size()) + ")");
  return sum.empty() ? "0" : sum;
}

namespace {

// "400", or "diag(50, 0)" of gains that are not the same along all axes.
std::string gain_notation(const std::vector<double>& gains) {
  if (std::adjacent_find(gains.begin(), gains.end(), std::not_equal_to<>()) == gains.end()) return format_significant(gains.front(), 4);
  std::vector<std::string> numbers;
  for (const double gain : gains) numbers.push_back(format_significant(gain, 4));
  return "diag(" + list_of(numbers, numbers.size()) + ")";
}

// "F = 400 N/m (x_{ref} - x) + 40 N s/m (xd_{ref} - xd)": what a spring and a damper at the end effector pull with.
std::string task_notation(const TaskFeedback& task) {
  const auto is_there = [](const std::vector<double>& gains) { return std::any_of(gains.begin(), gains.end(), [](double gain) { return gain != 0; }); };
  std::string force;
  if (is_there(task.kp)) force = gain_notation(task.kp) + " N/m\" \"(x_{ref} - x)";
  if (is_there(task.kd)) force += (force.empty() ? "" : " + ") + gain_notation(task.kd) + " N s/m\" \"(xd_{ref} - xd)";
  return force.empty() ? "" : "F = " + force;
}

}  // namespace

std::string resistance_notation(const Chain& chain) {
  std::vector<std::string> damping, friction;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Joint& joint = chain.bodies[b].joint;
    if (joint.kind == JointKind::floating) continue;
    damping.push_back(format_significant(joint.damping, 3));
    friction.push_back(format_significant(joint.friction, 3));
  }
  const std::string unit = unit_of(chain);
  std::string notation;
  const auto add = [&](const std::string& name, std::vector<std::string> values, const std::string& behind) {
    if (std::all_of(values.begin(), values.end(), [](const std::string& value) { return value == "0"; })) return;
    const bool same = std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
    notation += "\", " + name;
    if (same || values.size() <= kMostResistances)
      notation += " \"" + (same ? values[0] : "(" + list_of(values, values.size()) + ")") + (unit.empty() ? "" : behind);
    else
      notation += "\"";
  };
  add("damping", damping, unit + " s");
  add("friction", friction, unit);
  return notation;
}

namespace {

// With its unit behind it: in brackets, but numbers, and single products that end with a bracket of their own, as -80 (q_2 - 0.1). Of others
// the last factor would be read with the unit.
std::string with_unit(const std::string& entry, const std::string& unit) {
  if (parse_number(entry)) return entry + unit;
  int depth = 0;
  bool is_product = entry.ends_with(')');
  for (std::size_t i = 0; i < entry.size(); ++i) {
    depth += entry[i] == '(' || entry[i] == '{' ? 1 : entry[i] == ')' || entry[i] == '}' ? -1 : 0;
    if (depth == 0 && ((i > 0 && (entry[i] == '+' || entry[i] == '-')) || std::string_view("/<>=\",").find(entry[i]) != std::string_view::npos)) is_product = false;
  }
  return (is_product ? entry : "(" + entry + ")") + unit;
}

// "tau_1 = (8 - qd_1) N m" where all others are zero; "" where they are not, or it is no joint's alone.
std::string only_entry(const Chain& chain, const std::vector<std::string>& entries) {
  const auto is_zero = [](const std::string& entry) { return parse_number(entry) == 0.0; };
  if (entries.size() < 2 || std::ranges::count_if(entries, is_zero) + 1 != std::ptrdiff_t(entries.size())) return "";
  const auto place = std::ranges::find_if_not(entries, is_zero) - entries.begin();
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Body& body = chain.bodies[b];
    if (body.joint.v_index != int(place) || (body.joint.kind != JointKind::revolute && body.joint.kind != JointKind::prismatic)) continue;
    const std::string& entry = entries[std::size_t(place)];
    return "tau_" + std::to_string(place + 1) + " = " + with_unit(entry, body.joint.kind == JointKind::revolute ? " N m" : " N");
  }
  return "";
}

}  // namespace

std::vector<std::string> torque_notations(const Chain& chain, const std::vector<TorqueEntry>& torque,
                                          const std::optional<Control>& control) {
  if (control) {
    const std::string sum = "tau = " + control_notation(*control), force = control->task ? task_notation(*control->task) : "";
    if (!force.empty()) return {sum + ", " + force, sum, "tau = tau(t, q, qd)"};
    return {sum, "tau = tau(t, q, qd)"};
  }
  std::vector<std::string> entries;
  for (const TorqueEntry& entry : torque) {
    entries.push_back(entry.control ? control_notation(*entry.control) : conditional_notation(entry.text).value_or(entry_notation(entry.text)));
  }
  if (entries.empty()) entries.assign(std::size_t(chain.nv), "0");
  if (entries.empty()) return {};
  if (std::all_of(entries.begin(), entries.end(), [](const std::string& entry) { return parse_number(entry) == 0.0; })) return {"tau = 0"};
  if (entries.size() == 1 && parse_number(entries[0])) return {"tau = " + entries[0] + unit_of(chain)};
  std::vector<std::string> forms;
  const std::string alone = only_entry(chain, entries);
  // Of many zeros none tells anything.
  if (!alone.empty() && (unit_of(chain).empty() || entries.size() > kZerosTold + 1)) forms.push_back(alone);
  for (std::size_t shown = entries.size(); shown >= 2; --shown) {
    if (shown == entries.size() || shown <= 8)
      forms.push_back("tau = (" + list_of(entries, shown) + ")" + unit_of(chain));
  }
  if (entries.size() == 1) forms.push_back("tau = " + with_unit(entries[0], unit_of(chain)));
  if (!alone.empty()) forms.push_back(alone);
  forms.push_back("tau = tau(t, q, qd)");
  return forms;
}

namespace {

// "contact force 5 N": what `contact_force` adds to the torques, that constraints bear it.
std::string contact_notation(const Scene& scene) {
  if (scene.contact_force.empty()) return "";
  std::vector<std::string> sizes;
  for (const ContactEntry& one : scene.contact_force) {
    double square = 0;
    for (const double part : one.force) square += part * part;
    sizes.push_back(format_significant(std::sqrt(square), 4));
  }
  return std::string("\"contact force") + (sizes.size() > 1 ? "s " : " ") + joined(sizes) + " N\"";
}

// ", cut at 2 N m": what `limit: clamp` leaves of the torques.
std::string cut_notation(const Scene& scene, const Chain& chain) {
  if (scene.limit != LimitPolicy::clamp || scene.motion) return "";
  std::vector<double> efforts;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) efforts.push_back(chain.bodies[b].joint.limit.effort);
  if (std::none_of(efforts.begin(), efforts.end(), [](double effort) { return std::isfinite(effort); })) return "";
  const bool same = std::adjacent_find(efforts.begin(), efforts.end(), std::not_equal_to<>()) == efforts.end();
  const std::string unit = unit_of(chain);
  return same && !unit.empty() ? "\", cut at \"" + format_significant(efforts[0], 4) + unit : "\", cut at the joints' efforts\"";
}

// The forms of the sum, where the contact force acts besides.
std::vector<std::string> with_contact(std::vector<std::string> forms, const std::string& contact) {
  if (contact.empty()) return forms;
  if (forms == std::vector<std::string>{"tau = 0"}) return {"tau = " + contact};
  for (std::string& form : forms)
    if (form != "tau = tau(t, q, qd)") form += " + " + contact;
  return forms;
}

}  // namespace

std::vector<std::string> torque_notations(const Chain& chain, const Scene& scene) {
  std::vector<std::string> forms = with_contact(torque_notations(chain, scene.torque, scene.control), contact_notation(scene));
  for (std::string& form : forms) form += cut_notation(scene, chain);
  return forms;
}

namespace {

// What the torques of a recorded motion are.
std::vector<std::string> notations_of_replay() {
  return {"tau = M(q) qdd + h(q, qd) of the recorded motion", "tau = M(q) qdd + h(q, qd)"};
}

class TorqueLabel : public Layer {
 public:
  explicit TorqueLabel(const Stage& stage) : forms_(common_torque(stage)) {}
  void write(SheetText& text) const override { text.torque = forms_; }

 private:
  // What acts at the joints of all panels; nothing where they differ, since then their titles say it.
  static std::vector<std::string> common_torque(const Stage& stage) {
    const auto notations = [](const StagedRun& motion) -> std::vector<std::string> {
      if (motion.scene().motion) return notations_of_replay();
      std::vector<std::string> forms = torque_notations(motion.chain(), motion.scene());
      // Where nothing drives them, too, joints resist: energy that falls beside "tau = 0" has its cause here.
      const std::string resistance = resistance_notation(motion.chain());
      if (resistance.empty()) return forms;
      const std::vector<std::string> bare = forms;
      for (std::string& form : forms) form += resistance;
      forms.insert(forms.end(), bare.begin(), bare.end());
      return forms;
    };
    const std::vector<std::string> first = notations(stage.motions.front());
    const bool same = std::all_of(stage.motions.begin(), stage.motions.end(),
                                  [&](const StagedRun& motion) { return notations(motion) == first; });
    return same ? first : std::vector<std::string>{};
  }

  std::vector<std::string> forms_;
};

}  // namespace

std::unique_ptr<const Layer> make_layer_torque_label(const Stage& stage) {
  return std::make_unique<TorqueLabel>(stage);
}

}  // namespace chainreel
