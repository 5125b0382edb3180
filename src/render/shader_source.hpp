// The texts of shaders/, embedded when the program is built.
#pragma once

#include <string_view>

namespace chainreel {

struct EmbeddedShader {
  std::string_view name;  // "capsule.vert"
  std::string_view source;
};

extern const EmbeddedShader kEmbeddedShaders[];
extern const int kEmbeddedShaderCount;

// Throws Error (exit 4) for a name that is not embedded.
std::string_view shader_source(std::string_view name);

}  // namespace chainreel
