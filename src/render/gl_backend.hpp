// Where OpenGL comes from.
#pragma once

#include <span>

#include "core/names.hpp"
#include "render/canvas.hpp"

namespace chainreel {

// The libraries that contexts come from, both Mesa's, or none of them: pictures have the same bytes where these draw by llvmpipe.
enum class GlBackend { automatic, osmesa, egl, none };
std::span<const Name> names_of(GlBackend);

// To be called before the first context of the process.
void choose_gl_backend(GlBackend backend);

// Whether pages are drawn by a context, those that lie under films and those that are pictures by themselves.
bool opengl_draws(PageUse use);

}  // namespace chainreel
