// A function of the renderer that the program opens by name, linked: for the tool that finds what a package depends on.
// Part of no program.
#include <GL/osmesa.h>

extern "C" const void* const chainreel_opened_osmesa;
extern "C" const void* const chainreel_opened_osmesa = reinterpret_cast<const void*>(&OSMesaCreateContextAttribs);
