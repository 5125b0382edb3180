#include "picture/font_subset.hpp"

#include <hb-subset.h>

#include <memory>

#include "core/error.hpp"

namespace chainreel {
namespace {

template <auto destroy>
struct Destroyer {
  template <class T>
  void operator()(T* object) const {
    destroy(object);
  }
};
using Blob = std::unique_ptr<hb_blob_t, Destroyer<hb_blob_destroy>>;
using HbFace = std::unique_ptr<hb_face_t, Destroyer<hb_face_destroy>>;
using Input = std::unique_ptr<hb_subset_input_t, Destroyer<hb_subset_input_destroy>>;

}  // namespace

std::string font_subset(const Fonts& fonts, Face face, const std::set<char32_t>& characters) {
  const Blob whole(hb_blob_create_from_file(fonts.file(face).c_str()));
  const HbFace source(hb_face_create(whole.get(), 0));
  const Input input(hb_subset_input_create_or_fail());
  if (input == nullptr) throw Error(ExitCode::limit, "no memory for the fonts of a page");
  hb_subset_input_set_flags(input.get(), HB_SUBSET_FLAGS_NO_HINTING);
  for (const char32_t c : characters) hb_set_add(hb_subset_input_unicode_set(input.get()), c);
  const HbFace part(hb_subset_or_fail(source.get(), input.get()));
  if (part == nullptr)
    throw Error(ExitCode::no_renderer,
                "font file " + fonts.file(face) + " cannot be cut to the characters of a page");
  const Blob bytes(hb_face_reference_blob(part.get()));
  unsigned length = 0;
  const char* data = hb_blob_get_data(bytes.get(), &length);
  return std::string(data, length);
}

}  // namespace chainreel
