// A kind of constraint: its keys in the order in which they are read and written, what people are told of it,
// and what it means for a chain. Each alternative of ConstraintForm has one, in a file of its own, which its kind() returns. Internal.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "model/chain.hpp"
#include "model/constraint.hpp"
#include "scene/keys/own_keys.hpp"

namespace chainreel {

// What the words of an entry mean in the chain of its scene.
class ConstraintResolver {
 public:
  ConstraintResolver(const Scene& scene, const Chain& chain, ProblemList& problems)
      : scene_(scene), chain_(chain), problems_(problems) {}

  void begin(const Place& place) { place_ = place; }  // of the entry that is resolved next

  // Two numbers along the plane in which the chain moves, or three of the world. `what` they are is for
  // messages.
  Eigen::Vector3d world(const std::vector<double>& numbers, const std::string& what);
  // Of the two ends of a constraint the second: a place, or a frame of the chain. The frame `world` is the
  // world's origin, unless a link has that name.
  bool ends_at_place(const std::string& b) const;
  Eigen::Vector3d place_of(const std::string& b, const std::vector<double>& at, const std::string& what);

  const Scene& scene() const { return scene_; }
  const Place& place() const { return place_; }

 private:
  const Scene& scene_;
  const Chain& chain_;
  ProblemList& problems_;
  Place place_;
};

class ConstraintKind {
 public:
  ConstraintKind(Name name, const char* example) : name_(name), example_(example) {}
  virtual ~ConstraintKind() = default;

  const Name& name() const { return name_; }
  const char* example() const { return example_; }

  virtual KeyText tell() const = 0;
  virtual ConstraintForm read(Fields& fields, const Place& place) const = 0;
  virtual void write(YAML::Emitter& out, const ConstraintForm& form) const = 0;
  // Throws Error of what the form itself says wrongly; what does not fit the chain goes to the resolver's
  // problems.
  virtual Constraint resolve(const ConstraintForm& form, ConstraintResolver& resolver) const = 0;

 private:
  Name name_;
  const char* example_;
};

// In the order of the alternatives of ConstraintForm.
const std::vector<const ConstraintKind*>& constraint_kinds();
inline const ConstraintKind& kind_of(const ConstraintForm& form) {
  return *constraint_kinds()[form.index()];
}

// A member of a form that is a key.
template <class Form>
struct ConstraintKey {
  // No plain member: read and written by functions of its own.
  struct ByHand {
    void (*read)(Fields& fields, const Place& place, Form& form);
    void (*write)(YAML::Emitter& out, const Form& form);
    std::vector<KeyText> (*tell)();
  };
  using Value = std::variant<std::string Form::*, std::vector<double> Form::*, double Form::*, ByHand>;
  enum class Need {
    required,
    optional,
    either,  // of the keys of this need one must be there
  };

  const char* key;  // "": by hand
  Value value;
  const char* help = "";
  const char* unit = "";
  Need need = Need::required;
  bool is_expression = false;
};

template <class Form>
class ConstraintKindOf : public ConstraintKind {
 public:
  using Key = ConstraintKey<Form>;
  using Resolve = Constraint (*)(const Form& form, ConstraintResolver& resolver);

  ConstraintKindOf(Name name, const char* example, std::vector<Key> keys, Resolve meaning)
      : ConstraintKind(name, example), keys_(std::move(keys)), resolve_(meaning) {}

  KeyText tell() const override {
    std::vector<KeyText> parts;
    for (const Key& key : keys_)
      for (KeyText& part : told_key(key)) parts.push_back(std::move(part));
    KeyText text = told_record(name().name, std::move(parts), name().meaning);
    text.example = example();
    return text;
  }

  ConstraintForm read(Fields& fields, const Place& place) const override {
    Form form;
    std::vector<std::string> either;
    for (const Key& key : keys_) {
      read_key(fields, place, form, key);
      if (key.need == Key::Need::either) either.emplace_back(key.key);
    }
    int given = 0;
    for (const std::string& key : either) given += fields.has(key);
    if (!either.empty() && given != 1)
      fields.problems().add("'" + fields.path("b") +
                                "' names a frame, or 'at' a place, one of the two: write " + example() +
                                ", or `at: [x, y]` in the place of b",
                            place);
    return form;
  }

  void write(YAML::Emitter& out, const ConstraintForm& form) const override {
    for (const Key& key : keys_) write_key(out, std::get<Form>(form), key);
  }

  Constraint resolve(const ConstraintForm& form, ConstraintResolver& resolver) const override {
    return resolve_(std::get<Form>(form), resolver);
  }

 private:
  static std::vector<KeyText> told_key(const Key& key) {
    if (const auto* hand = std::get_if<3>(&key.value)) return hand->tell();
    KeyText part = key.value.index() == 1 ? told_list(key.key, told("", KeyForm::number, ""), key.help)
                                          : told(key.key,
                                                 key.value.index() == 2 ? KeyForm::number
                                                 : key.is_expression    ? KeyForm::expression
                                                                        : KeyForm::text,
                                                 key.help);
    part.unit = key.unit;
    part.is_required = key.need == Key::Need::required;
    return {std::move(part)};
  }

  void read_key(Fields& fields, const Place& place, Form& form, const Key& key) const {
    if (const auto* hand = std::get_if<3>(&key.value)) return hand->read(fields, place, form);
    if (key.need == Key::Need::required && !fields.has(key.key))
      return fields.problems().add("'" + fields.path(key.key) + "' is missing: write " + example(), place);
    if (const auto* text = std::get_if<0>(&key.value)) fields.read(key.key, form.**text);
    if (const auto* numbers = std::get_if<1>(&key.value)) fields.read(key.key, form.**numbers);
    if (const auto* number = std::get_if<2>(&key.value)) fields.read(key.key, form.**number);
  }

  static void write_key(YAML::Emitter& out, const Form& form, const Key& key) {
    if (const auto* hand = std::get_if<3>(&key.value)) return hand->write(out, form);
    const auto name = [&]() -> YAML::Emitter& { return out << YAML::Key << key.key << YAML::Value; };
    if (const auto* text = std::get_if<0>(&key.value); text && !(form.**text).empty()) {
      if (key.is_expression)
        name() << YAML::DoubleQuoted << form.**text;
      else
        name() << form.**text;
    }
    if (const auto* numbers = std::get_if<1>(&key.value); numbers && !(form.**numbers).empty())
      emit_numbers(name(), form.**numbers);
    if (const auto* number = std::get_if<2>(&key.value)) name() << format_shortest(form.**number);
  }

  std::vector<Key> keys_;
  Resolve resolve_;
};

}  // namespace chainreel
