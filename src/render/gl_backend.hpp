// Where OpenGL comes from.
#pragma once

#include <span>

#include "core/names.hpp"

namespace chainreel {

// The libraries that contexts come from, both Mesa's: where both draw by llvmpipe, pictures have the same bytes.
enum class GlBackend { automatic, osmesa, egl };
std::span<const Name> names_of(GlBackend);

// To be called before the first context of the process.
void choose_gl_backend(GlBackend backend);

}  // namespace chainreel
