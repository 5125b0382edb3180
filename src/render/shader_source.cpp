#include "render/shader_source.hpp"

#include <span>
#include <string>

#include "core/error.hpp"

namespace chainreel {

std::string_view shader_source(std::string_view name) {
  for (const EmbeddedShader& shader : std::span(kEmbeddedShaders, std::size_t(kEmbeddedShaderCount)))
    if (shader.name == name) return shader.source;
  throw Error(ExitCode::no_renderer, "shader " + std::string(name) + " is not part of this build");
}

}  // namespace chainreel
