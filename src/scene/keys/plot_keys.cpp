// The key plot.
#include "scene/keys/own_keys.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMostPlots = 3;

PlotEntry read_entry(Fields& fields, const YAML::Node& node, const std::string& key) {
  PlotEntry entry;
  entry.place = fields.place_of(node, key);
  if (node.IsScalar()) {
    entry.value = node.Scalar();
  } else if (node.IsMap()) {
    Fields inner(fields.document(), node, key, fields.problems());
    inner.read("value", entry.value);
    if (!entry.value.empty()) entry.place = inner.place_of(inner.find("value"), "value");
    inner.read("title", entry.title);
    inner.read("scale", entry.scale);
    inner.finish();
  }
  if (entry.value.empty())
    fields.problems().add("'" + key + "' must be " + joined(words_of(names_of(PlotQuantity{}))) +
                              " or an expression; with a title of its own: {value: y_G - 1, title: \"height [m]\"}",
                          entry.place);
  return entry;
}

}  // namespace

KeyText told_plot() {
  const auto value = [](const char* name) {
    return told(name, KeyForm::expression,
                "a quantity or an expression; the quantities are " + joined(words_of(names_of(PlotQuantity{}))));
  };
  const auto entry = [&] {
    return told_either("", {value(""), told_record("", {value("value").required(),
                                                        told("title", KeyForm::text,
                                                             "of the axis, its unit in brackets"),
                                                        told_word("scale", names_of(PlotScale{}), "of the axis of its numbers; linear where left out")},
                                                   "a plot with a title or a scale of its own")},
                       "a plot");
  };
  std::vector<KeyText> forms = entry().parts;
  forms.push_back(told_list("", entry(), "up to three plots"));
  return told_either("plot", std::move(forms),
                     "plots below or beside the scene, up to three");
}

std::string plot_text(const Scene& scene) {
  if (scene.plot.empty()) return "";
  return flow_text([&](YAML::Emitter& out) {
    out << YAML::Flow << YAML::BeginSeq;
    for (const PlotEntry& plot : scene.plot) {
      if (plot.title.empty() && plot.scale == PlotScale::linear) {
        out << YAML::DoubleQuoted << plot.value;
        continue;
      }
      out << YAML::Flow << YAML::BeginMap;
      out << YAML::Key << "value" << YAML::Value << YAML::DoubleQuoted << plot.value;
      if (!plot.title.empty()) out << YAML::Key << "title" << YAML::Value << YAML::DoubleQuoted << plot.title;
      if (plot.scale != PlotScale::linear) out << YAML::Key << "scale" << YAML::Value << to_string(plot.scale);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  });
}

void read_plot(Fields& fields, Scene& scene) {
  const YAML::Node node = fields.find("plot");
  if (!node.IsDefined() || node.IsNull()) return;
  if (!node.IsSequence()) {
    scene.plot = {read_entry(fields, node, fields.path("plot"))};
    return;
  }
  for (std::size_t i = 0; i < node.size(); ++i)
    scene.plot.push_back(read_entry(fields, node[i], fields.path("plot." + std::to_string(i + 1))));
  if (scene.plot.size() > kMostPlots)
    fields.problems().add("'plot' names " + std::to_string(scene.plot.size()) +
                              " plots, but no more than three fit beside a scene",
                          fields.place_of(node, "plot"));
}

}  // namespace chainreel
