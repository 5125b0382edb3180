// Where OpenGL comes from.
#pragma once

#include <span>

#include "core/names.hpp"

namespace chainreel {

// The libraries that contexts come from, both Mesa's, or none of them: pictures have the same bytes where these draw by llvmpipe.
enum class GlBackend { automatic, osmesa, egl, none };
std::span<const Name> names_of(GlBackend);

// To be called before the first context of the process.
void choose_gl_backend(GlBackend backend);

// What a page is drawn for: it lies under a film, or is a picture by itself. For one of these OpenGL's library would take longer to
// open than all else takes, and beside a film of many thousand frames more memory than is left.
enum class PageUse { film, long_film, still };
// Whether pages of this use are drawn by a context, else filled in memory: those of ordinary films; others where --gl names a library.
bool opengl_draws(PageUse use);

}  // namespace chainreel
