#include "scene/text/asked_instant.hpp"

#include <algorithm>

#include "core/format.hpp"
#include "scene/quantity.hpp"

namespace chainreel {
namespace {

constexpr std::string_view kEvent = "event";
constexpr const char* kForms = "write seconds, like 1.2s, or `event NAME`";

bool is_event(const std::string& text) {
  return text == kEvent || text.starts_with(std::string(kEvent) + " ");
}

// Of all panels, each once.
std::vector<std::string> events_of(const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const Scene& panel) {
    for (const EventEntry& event : panel.events)
      if (std::find(names.begin(), names.end(), event.title()) == names.end()) names.push_back(event.title());
  };
  if (scene.compare.empty()) add(scene);
  for (const Scene& panel : scene.compare) add(panel);
  return names;
}

}  // namespace

std::string AskedInstant::name() const {
  return event.empty() ? format_shortest(at) + "s" : event;
}

NamedText named_instant(const std::string& part) {
  return is_event(trimmed(part)) ? NamedText{"", part} : named_text(part);
}

namespace {

// Whether a part of a list is an instant by itself: names of events may hold commas, too.
bool begins_an_instant(const std::string& part) {
  const std::string text = trimmed(named_instant(part).text);
  if (text.empty() || is_event(text)) return true;
  try {
    parse_quantity(text, {}, "s");
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> parted_instants(const std::string& text) {
  std::vector<std::string> parts{""};
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::size_t i = 1; i < parts.size();) {
    if (!is_event(trimmed(named_instant(parts[i - 1]).text)) || begins_an_instant(parts[i])) {
      ++i;
      continue;
    }
    parts[i - 1] += "," + parts[i];
    parts.erase(parts.begin() + std::ptrdiff_t(i));
  }
  return parts;
}

AskedInstant parse_asked_instant(const std::string& text, const Place& place) {
  AskedInstant asked;
  asked.text = trimmed(text);
  if (is_event(asked.text)) {
    asked.event = trimmed(asked.text.substr(kEvent.size()));
    if (asked.event.empty())
      throw Error(ExitCode::bad_input, std::string("`event` names no event: ") + kForms, place);
    return asked;
  }
  try {
    asked.at = parse_quantity(asked.text, place, "s") + 0.0;  // no -0
  } catch (const Error&) {
    throw Error(ExitCode::bad_input, "'" + shortened(asked.text, 80) + "' is no instant: " + kForms, place);
  }
  if (asked.at < 0)
    throw Error(ExitCode::bad_input, "'" + asked.text + "' lies before the start: an instant is 0 or later",
                place);
  return asked;
}

std::string trouble_of_instant(const AskedInstant& asked, const Scene& scene) {
  if (asked.event.empty()) {
    if (asked.at <= scene.duration) return "";
    return asked.text + " lies behind the end of " + scene.file + ", whose duration is " +
           format_shortest(scene.duration) + " s: take an earlier instant";
  }
  const std::vector<std::string> names = events_of(scene);
  if (std::find(names.begin(), names.end(), asked.event) != names.end()) return "";
  if (names.empty())
    return scene.file + " looks out for no event, so none is '" + asked.event + "': add it to its `events:`";
  return scene.file + " has no event '" + asked.event + "':" + did_you_mean(asked.event, names) + " It has " +
         quoted_list(names) + ".";
}

}  // namespace chainreel
