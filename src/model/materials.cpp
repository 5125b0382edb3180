#include "model/materials.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/texture.hpp"

namespace chainreel {

Materials::Materials(const UrdfFile& file, const ModelOptions& options)
    : finder_(file.path, options.packages) {
  for (const UrdfMaterial& material : file.materials) remember(material);
  for (const UrdfLink& link : file.links)
    for (const UrdfShape& shape : link.visuals)
      if (shape.material) remember(*shape.material);
}

const UrdfMaterial* Materials::meaning_of(const UrdfMaterial& material) const {
  if (material.says_something()) return &material;
  const auto known = known_.find(material.name);
  return material.name.empty() || known == known_.end() ? nullptr : &known->second;
}

std::optional<MaterialRgba> Materials::color_of(const UrdfMaterial& material, const std::string& link,
                                                UrdfProblems& problems) {
  if (const UrdfMaterial* meaning = meaning_of(material)) return look_of(*meaning);
  if (material.name.empty() || without_file_.contains(material.name)) return std::nullopt;
  const std::string near = problems.is_full() ? "" : near_name(material.name, names_);
  problems.add(material.line, "link '" + link + "' names the material '" + material.name +
                                  "', which has no colour anywhere:" +
                                  (near.empty() ? " write <color rgba=\"0.5 0.5 0.5 1\"/> in it" : near));
  return std::nullopt;
}

void Materials::remember(const UrdfMaterial& material) {
  if (material.has_empty_texture) without_file_.insert(material.name);
  if (material.name.empty() || !material.says_something()) return;
  if (known_.emplace(material.name, material).second) names_.push_back(material.name);
}

// A texture is the mean of its image, and opaque unless there is a colour, too.
std::optional<MaterialRgba> Materials::look_of(const UrdfMaterial& material) {
  std::optional<MaterialRgba> color;
  if (material.rgba) {
    color.emplace();
    for (std::size_t i = 0; i < 4; ++i) (*color)[i] = std::uint8_t(std::lround(255 * (*material.rgba)[i]));
  }
  if (material.texture.empty()) return color;
  const auto [mean, is_new] = means_.try_emplace(material.texture);
  if (is_new) mean->second = read_mean_color(finder_.find(material.texture).path);
  if (!mean->second) return color;
  if (!color) color = MaterialRgba{0, 0, 0, 255};
  std::copy(mean->second->begin(), mean->second->end(), color->begin());
  return color;
}

}  // namespace chainreel
