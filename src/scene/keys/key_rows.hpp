// How the table of keys writes its rows: a member of the scene, whose type says how it is read and written, and what
// is told of it. Internal.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "scene/keys/fields.hpp"
#include "scene/keys/keys.hpp"

namespace chainreel {

// A value in one line of YAML; "": there is none.
std::string text_of(const std::string& value);
std::string text_of(bool value);
std::string text_of(int value);
std::string text_of(double value);
std::string text_of(FrameRate value);
std::string text_of(const Accuracy& value);
std::string text_of(const std::vector<double>& value);
std::string text_of(const Eigen::Vector3d& value);
template <Named Enum>
std::string text_of(Enum value) {
  return to_string(value);
}
template <class T>
std::string text_of(const std::optional<T>& value) {
  return value ? text_of(*value) : "";
}

// What is told of a value of this type.
inline KeyText told_of(const std::string&) { return told("", KeyForm::text, ""); }
inline KeyText told_of(bool) { return told("", KeyForm::truth, ""); }
inline KeyText told_of(int) { return told("", KeyForm::whole, ""); }
inline KeyText told_of(double) { return told("", KeyForm::number, ""); }
inline KeyText told_of(FrameRate) { return told("", KeyForm::rate, ""); }
inline KeyText told_of(const Accuracy&) { return told("", KeyForm::accuracy, ""); }
inline KeyText told_of(const std::vector<double>&) { return told_list("", told_of(0.0), ""); }
inline KeyText told_of(const Eigen::Vector3d&) { return told_list("", told_of(0.0), ""); }
template <Named Enum>
KeyText told_of(Enum value) {
  return told_word("", names_of(value), "");
}
template <class T>
KeyText told_of(const std::optional<T>&) {
  return told_of(T{});
}

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

// The number that a range is of, where the value is one.
template <class T>
std::optional<double> number_in(const T& value) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) return double(value);
  if constexpr (std::is_same_v<T, std::optional<double>> || std::is_same_v<T, std::optional<int>>)
    return value ? std::optional<double>(*value) : std::nullopt;
  return std::nullopt;
}

// Whether the key holds the row's word for a number without end.
bool is_endless(const SceneKey& key, Fields& fields);
// A problem where the number lies beyond the row's range.
void check_range(const SceneKey& key, Fields& fields, double value);
// Writes the text of a key that means something in the scene.
SceneKey::Write line_writer();

class KeyRow {
 public:
  template <class T>
  KeyRow(const char* name, T Scene::*member, const char* help) {
    make<T>(
        name, help, [member](Scene& scene) -> T& { return scene.*member; },
        [member](const Scene& scene) { return &(scene.*member); });
  }
  template <class Part, class T>
  KeyRow(const char* name, Part Scene::*part, T Part::*member, const char* help) {
    make<T>(
        name, help, [part, member](Scene& scene) -> T& { return scene.*part.*member; },
        [part, member](const Scene& scene) { return &(scene.*part.*member); });
  }
  // A member of a part that the scene need not have.
  template <class Part, class T>
  KeyRow(const char* name, std::optional<Part> Scene::*part, T Part::*member, const char* help) {
    make<T>(
        name, help,
        [part, member](Scene& scene) -> T& {
          if (!(scene.*part)) (scene.*part).emplace();
          return *(scene.*part).*member;
        },
        [part, member](const Scene& scene) { return scene.*part ? &(*(scene.*part).*member) : nullptr; });
  }
  // A key that is read and written by hand.
  KeyRow(KeyText text, void (*read)(Fields&, Scene&), std::string (*write)(const Scene&));
  // ... with names of one's own below it: a line each.
  KeyRow(KeyText text, void (*read)(Fields&, Scene&), void (*write)(const Scene&, std::vector<SceneEntry>&));
  // A mapping, whose keys are the rows behind it.
  static KeyRow section(const char* name, const char* example, const char* help);
  // ... which may be one value for all of them.
  KeyRow&& or_one(SceneKey::Read read) && { return key_.read = std::move(read), std::move(*this); }

  KeyRow&& in(const char* unit) && { return key_.unit = unit, std::move(*this); }
  KeyRow&& within(double least, double most) && { return key_.range = {least, most, false}, std::move(*this); }
  KeyRow&& at_least(double least) && { return key_.range.least = least, std::move(*this); }
  KeyRow&& above(double least) && { return key_.range.least = least, key_.range.is_open = true, std::move(*this); }
  KeyRow&& up_to(double most) && { return key_.range.most = most, std::move(*this); }
  KeyRow&& hint(const char* text) && { return key_.hint = text, std::move(*this); }
  KeyRow&& or_endless(const char* word) && { return key_.infinity = word, std::move(*this); }
  KeyRow&& absent(const char* words) && { return key_.absent = words, std::move(*this); }
  KeyRow&& example(const char* text) && { return key_.example = text, std::move(*this); }
  KeyRow&& of_page() && { return key_.of = KeyOf::page, std::move(*this); }
  KeyRow&& flag(FlagGroup group, const char* name) && { return key_.flags = group, key_.flag = name, std::move(*this); }
  KeyRow&& of_model(OfModel use) && { return key_.of_model = use, std::move(*this); }
  KeyRow&& seen_at_poses() && { return key_.is_seen_at_poses = true, std::move(*this); }
  // Of a list of the start: single numbers may be named by their joints.
  KeyRow&& by_joint(std::vector<double> StartState::*list, std::vector<JointNumbers> StartState::*of_joints) && {
    key_.read = [list, of_joints](const SceneKey& key, Fields& fields, Scene& scene) {
      if (!fields.has(key.leaf())) return;
      fields.measure_in(key.unit);
      fields.read_some(key.leaf(), scene.start.*list, scene.start.*of_joints);
      fields.measure_in("");
    };
    const KeyText number = told("", KeyForm::number, "");
    static_cast<KeyText&>(key_) = told_either(key_.name, {told_list("", number, ""), told_mapping("", number, "")}, key_.help);
    return std::move(*this);
  }
  KeyRow&& caption(const char* text) && { return key_.caption = text, std::move(*this); }
  KeyRow&& no_caption() && { return key_.is_captioned = false, std::move(*this); }
  // Written only where it means something.
  KeyRow&& where(bool (*means_something)(const Scene&)) && {
    return key_.means_something = means_something, std::move(*this);
  }

  SceneKey key() && { return std::move(key_); }

 private:
  KeyRow() = default;

  template <class T, class Get, class See>
  void make(const char* name, const char* help, Get get, See see) {
    static_cast<KeyText&>(key_) = told_of(T{});
    key_.name = name;
    key_.help = help;
    key_.takes_null = std::is_same_v<T, Accuracy> || is_optional<T>;
    key_.read = [get](const SceneKey& key, Fields& fields, Scene& scene) {
      if (!fields.find(key.leaf()).IsDefined()) return;
      T& value = get(scene);
      if constexpr (std::is_same_v<T, std::optional<double>>)
        if (is_endless(key, fields)) return void(value = std::numeric_limits<double>::infinity());
      fields.measure_in(key.unit);
      const bool is_read = [&] {
        if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::optional<Eigen::Vector3d>>)
          return fields.read_some(key.leaf(), value);
        else
          return fields.read(key.leaf(), value);
      }();
      fields.measure_in("");
      if (!is_read) return;
      if (const auto number = number_in(value)) check_range(key, fields, *number);
    };
    key_.text = [see](const SceneKey& key, const Scene& scene) {
      const T* value = see(scene);
      if constexpr (std::is_same_v<T, std::optional<double>>)
        if (value && *value && std::isinf(**value)) return key.infinity;
      return value ? text_of(*value) : "";
    };
    key_.write = line_writer();
  }

  SceneKey key_;
};

}  // namespace chainreel
