// Cairo's functions, found when the first page of vectors, or a picture inside one, is drawn: it brings the libraries of windows
// along, which took a thirtieth of the time of a picture of pixels to load, and those need none of them.
#pragma once

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>

namespace chainreel {

// clang-format off
#define CHAINREEL_CAIRO(X)                                                                                         \
  X(cairo_arc) X(cairo_arc_negative) X(cairo_clip) X(cairo_close_path) X(cairo_create) X(cairo_destroy)            \
  X(cairo_fill) X(cairo_fill_preserve) X(cairo_font_face_destroy) X(cairo_font_face_set_user_data)                 \
  X(cairo_font_options_create) X(cairo_font_options_destroy) X(cairo_font_options_set_antialias)                   \
  X(cairo_font_options_set_hint_metrics) X(cairo_font_options_set_hint_style)                                      \
  X(cairo_ft_font_face_create_for_ft_face) X(cairo_get_matrix) X(cairo_get_source) X(cairo_glyph_path)             \
  X(cairo_image_surface_create) X(cairo_image_surface_get_data) X(cairo_image_surface_get_stride) X(cairo_line_to) \
  X(cairo_mask) X(cairo_move_to) X(cairo_new_path) X(cairo_paint) X(cairo_pattern_add_color_stop_rgba)             \
  X(cairo_pattern_create_linear) X(cairo_pattern_destroy) X(cairo_pattern_set_filter)                              \
  X(cairo_pdf_surface_create_for_stream) X(cairo_pdf_surface_set_metadata) X(cairo_pop_group)                      \
  X(cairo_pop_group_to_source) X(cairo_push_group) X(cairo_push_group_with_content) X(cairo_rectangle)             \
  X(cairo_restore) X(cairo_save) X(cairo_scale) X(cairo_set_font_face) X(cairo_set_font_options)                   \
  X(cairo_set_font_size) X(cairo_set_line_cap) X(cairo_set_line_join) X(cairo_set_line_width) X(cairo_set_matrix)  \
  X(cairo_set_source) X(cairo_set_source_rgba) X(cairo_set_source_surface) X(cairo_show_text_glyphs)               \
  X(cairo_status) X(cairo_status_to_string) X(cairo_stroke) X(cairo_stroke_preserve) X(cairo_surface_destroy)      \
  X(cairo_surface_finish) X(cairo_surface_flush) X(cairo_surface_mark_dirty) X(cairo_surface_status)               \
  X(cairo_surface_write_to_png_stream) X(cairo_transform) X(cairo_translate)
// clang-format on

struct CairoFunctions {
#define CHAINREEL_CAIRO_MEMBER(name) decltype(&::name) name = nullptr;
  CHAINREEL_CAIRO(CHAINREEL_CAIRO_MEMBER)
#undef CHAINREEL_CAIRO_MEMBER
};

// Opens the library at the first call; it stays. Throws Error (exit 4) naming the package where it is not
// there.
const CairoFunctions& libcairo();

}  // namespace chainreel
