// Functions of what the renderer opens by name, linked: for the tool that finds what a package depends on. Part of no program.
#include <GL/osmesa.h>

#include "render/cairo_functions.hpp"

extern "C" const void* const chainreel_opened_osmesa;
extern "C" const void* const chainreel_opened_osmesa = reinterpret_cast<const void*>(&OSMesaCreateContextAttribs);

#define CHAINREEL_ADDRESS(name) reinterpret_cast<const void*>(&::name),
extern "C" const void* const chainreel_opened_cairo[];
extern "C" const void* const chainreel_opened_cairo[] = {CHAINREEL_CAIRO(CHAINREEL_ADDRESS)};
