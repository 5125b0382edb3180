#include "draw/layers/layer.hpp"

namespace chainreel {

#define CHAINREEL_MAKE_LAYER(layer, name, by_default, needs, meaning) \
  std::unique_ptr<const Layer> make_layer_##layer(const Stage& stage);
CHAINREEL_LAYERS(CHAINREEL_MAKE_LAYER)
#undef CHAINREEL_MAKE_LAYER

bool Layer::covers(const Sight&, const Rect&, bool) const {
  return false;
}

Layers layers_of(const Stage& stage) {
  using Make = std::unique_ptr<const Layer> (*)(const Stage&);
#define CHAINREEL_MAKER(layer, name, by_default, needs, meaning) make_layer_##layer,
  static constexpr Make kMakers[] = {CHAINREEL_LAYERS(CHAINREEL_MAKER)};
#undef CHAINREEL_MAKER
  Layers layers;
  for (std::size_t i = 0; i < std::size(kLayerRows); ++i)
    if (stage.shows(kLayerRows[i])) layers.push_back(kMakers[i](stage));
  return layers;
}

}  // namespace chainreel
