// Opening of font files, shaping and outlines. All measures are taken at font units, before any output size
// is known.
#include "picture/fonts.hpp"

#include <ft2build.h>
#include <hb-ot.h>
#include FT_BBOX_H
#include FT_OUTLINE_H
#include <hb-subset.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/own_environment.hpp"
#include "picture/fonts_state.hpp"
#include "picture/shaping.hpp"
#include "picture/text.hpp"

namespace chainreel {
namespace {

struct FaceFile {
  const char* name;
  const char* file;
  const char* package;
};

constexpr std::array<FaceFile, 3> kFaceFiles = {{
    {"DejaVu Sans", "DejaVuSans.ttf", "fonts-dejavu-core"},
    {"DejaVu Sans Bold", "DejaVuSans-Bold.ttf", "fonts-dejavu-core"},
    {"Latin Modern Math", "latinmodern-math.otf", "fonts-lmodern"},
}};

// Where Debian's packages put these files, and where an administrator would.
const std::vector<std::string> kFontFolders = {"/usr/share/fonts/truetype/dejavu",
                                               "/usr/share/texmf/fonts/opentype/public/lm-math",
                                               "/usr/local/share/fonts"};

std::string find_font_file(const FaceFile& wanted, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    const auto path = std::filesystem::path(folder) / wanted.file;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path.string();
  }
  throw Error(ExitCode::no_renderer, std::string("font file ") + wanted.file + " not found in " + joined(folders) +
                                         "; install the Debian package " + wanted.package);
}

}  // namespace

void clear_font_variables() {
  constexpr std::array<std::string_view, 2> kOfFonts = {"FREETYPE_PROPERTIES", "HB_"};
  static std::once_flag once;
  std::call_once(once, [&] { clear_variables(kOfFonts); });
}

Fonts::State::State() {
  clear_font_variables();
  if (FT_Init_FreeType(&library) != 0) throw Error(ExitCode::no_renderer, "FreeType does not start");
}

Fonts::State::~State() {
  const auto close = [](Entry& entry) {
    hb_font_destroy(entry.hb_font);
    if (entry.ft_face != nullptr) FT_Done_Face(entry.ft_face);
    hb_blob_destroy(entry.blob);
  };
  for (Entry& entry : faces) close(entry);
  for (Entry& entry : fallbacks) close(entry);
  for (Candidate& candidate : candidates) hb_set_destroy(candidate.characters);
  FT_Done_FreeType(library);
}

Fonts::State::Entry& Fonts::State::entry(Face face) {
  if (int(face) < kOwnFaces) return faces[std::size_t(face)];
  const std::lock_guard lock(fallback);
  return fallbacks[std::size_t(face) - kOwnFaces];
}

void Fonts::State::open(Entry& e, const FontFile& at) {
  e.file = at.file;
  e.index = at.index;
  errno = 0;
  e.blob = hb_blob_create_from_file(e.file.c_str());
  unsigned length = 0;
  const char* data = hb_blob_get_data(e.blob, &length);
  if (length == 0 || FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(data), FT_Long(length), e.index, &e.ft_face) != 0)
    throw Error(ExitCode::no_renderer, "font file " + e.file + " cannot be read" +
                                           (errno != 0 ? std::string(": ") + std::strerror(errno) : "") + e.remedy);

  hb_face_t* hb_face = hb_face_create(e.blob, unsigned(e.index));
  e.hb_font = hb_font_create(hb_face);
  const int units = int(hb_face_get_upem(hb_face));
  hb_font_set_scale(e.hb_font, units, units);
  hb_font_make_immutable(e.hb_font);
  hb_face_destroy(hb_face);
  e.units_per_em = units;
}

namespace {

void open_own(Fonts::State& state, std::size_t which, const std::vector<std::string>& folders) {
  const FaceFile& own = kFaceFiles[which];
  Fonts::State::Entry& e = state.faces[which];
  e.name = std::string(own.name) + " (" + own.package + ")";
  e.remedy = std::string("; if it is broken, reinstall the Debian package ") + own.package;
  state.open(e, {find_font_file(own, folders), 0});
}

void open_family(Fonts::State& state, std::size_t which, const std::string& family, WantedFace wanted) {
  Fonts::State::Entry& e = state.faces[which];
  e.name = family;
  state.open(e, find_font(state.library, family, wanted));
  if (wanted == WantedFace::math && !hb_ot_math_has_data(hb_font_get_face(e.hb_font)))
    throw Error(ExitCode::no_renderer, "font family '" + family + "' (" + e.file +
                                           ") has no MATH table: formulas need one, like those of Latin Modern Math or STIX Two Math");
}

}  // namespace

Fonts::Fonts(const FontFamilies& families) : state_(std::make_unique<State>()) {
  state_->folders = font_folders();
  const std::string bold = families.bold.empty() ? families.label : families.bold;
  const std::pair<const std::string&, WantedFace> wanted[] = {
      {families.label, WantedFace::regular}, {bold, WantedFace::bold}, {families.math, WantedFace::math}};
  for (std::size_t i = 0; i < kFaceFiles.size(); ++i)
    if (wanted[i].first.empty())
      open_own(*state_, i, kFontFolders);
    else
      open_family(*state_, i, wanted[i].first, wanted[i].second);
}

Fonts::Fonts(const std::vector<std::string>& folders) : state_(std::make_unique<State>()) {
  state_->folders = folders;
  for (std::size_t i = 0; i < kFaceFiles.size(); ++i) open_own(*state_, i, folders);
}

Fonts::~Fonts() = default;

FT_FaceRec_* Fonts::ft_face(Face face) const {
  return state_->entry(face).ft_face;
}

const std::string& Fonts::file(Face face) const {
  return state_->entry(face).file;
}

int Fonts::index(Face face) const {
  return state_->entry(face).index;
}

const std::string& Fonts::sha256(Face face) const {
  State::Entry& entry = state_->entry(face);
  std::call_once(entry.hashed, [&entry] {
    unsigned length = 0;
    const char* data = hb_blob_get_data(entry.blob, &length);
    Sha256 hash;
    hash.add(std::as_bytes(std::span(data, length)));
    entry.sha256 = hash.finish();
  });
  return entry.sha256;
}

namespace {

void unite(ShapedText& shaped, const Rect& ink) {
  if (!shaped.has_ink) {
    shaped.ink = ink;
    shaped.has_ink = true;
    return;
  }
  shaped.ink = {std::min(shaped.ink.x0, ink.x0), std::min(shaped.ink.y0, ink.y0),
                std::max(shaped.ink.x1, ink.x1), std::max(shaped.ink.y1, ink.y1)};
}

void add_ink(ShapedText& shaped, FT_Face face, const Glyph& glyph, double units_per_em) {
  if (FT_Load_Glyph(face, glyph.index, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING) != 0 ||
      face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    throw Error(ExitCode::no_renderer, "a glyph of " + std::string(face->family_name) + " has no outline");
  FT_BBox box;
  FT_Outline_Get_BBox(&face->glyph->outline, &box);
  if (box.xMin >= box.xMax || box.yMin >= box.yMax) return;  // a space
  unite(shaped, {glyph.x + double(box.xMin) / units_per_em, glyph.y + double(box.yMin) / units_per_em,
                 glyph.x + double(box.xMax) / units_per_em, glyph.y + double(box.yMax) / units_per_em});
}

struct BufferDeleter {
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
using Buffer = std::unique_ptr<hb_buffer_t, BufferDeleter>;

Buffer buffer_of(std::u32string_view line, std::size_t begin, std::size_t end) {
  Buffer buffer(hb_buffer_create());
  hb_buffer_add_codepoints(buffer.get(), reinterpret_cast<const hb_codepoint_t*>(line.data()), int(line.size()), unsigned(begin),
                           int(end - begin));
  return buffer;
}

// What stands in a buffer whose text begins at `begin` of the line.
ShapedText shaped_in(const Fonts& fonts, Face face, hb_buffer_t* buffer, std::u32string_view line, std::size_t begin) {
  Fonts::State::Entry& entry = fonts.state().entry(face);
  hb_shape(entry.hb_font, buffer, nullptr, 0);

  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer, &count);
  const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer, &count);
  ShapedText shaped;
  long pen_x = 0, pen_y = 0;  // font units
  const std::lock_guard lock(fonts.state().outlines);
  for (unsigned i = 0; i < count; ++i) {
    if (infos[i].codepoint == 0)
      throw Error(ExitCode::no_renderer, entry.name + " has no glyph for " + code_point_name(line[infos[i].cluster]) + " in '" +
                                             encode_utf8(line) + "'");
    const Glyph glyph = {infos[i].codepoint, double(pen_x + positions[i].x_offset) / entry.units_per_em,
                         double(pen_y + positions[i].y_offset) / entry.units_per_em,
                         std::uint32_t(infos[i].cluster - begin)};
    add_ink(shaped, entry.ft_face, glyph, entry.units_per_em);
    shaped.glyphs.push_back(glyph);
    pen_x += positions[i].x_advance;
    pen_y += positions[i].y_advance;
  }
  shaped.advance = double(pen_x) / entry.units_per_em;
  return shaped;
}

// Never that of the environment: it may choose other glyphs.
hb_language_t language_of(hb_script_t script) {
  switch (script) {
    case HB_SCRIPT_HIRAGANA:
    case HB_SCRIPT_KATAKANA: return hb_language_from_string("ja", -1);
    case HB_SCRIPT_HANGUL: return hb_language_from_string("ko", -1);
    default: return hb_language_from_string("en", -1);
  }
}

}  // namespace

std::string code_point_name(char32_t c) {
  char name[16];
  std::snprintf(name, sizeof name, "U+%04X", unsigned(c));
  return name;
}

ShapedText shape(const Fonts& fonts, Face face, std::u32string_view text) {
  const Buffer buffer = buffer_of(text, 0, text.size());
  hb_buffer_set_language(buffer.get(), language_of(HB_SCRIPT_LATIN));
  hb_buffer_guess_segment_properties(buffer.get());
  return shaped_in(fonts, face, buffer.get(), text, 0);
}

ShapedText shape(const Fonts& fonts, const TextRun& run, std::u32string_view line) {
  const Buffer buffer = buffer_of(line, run.begin, run.end);  // with its neighbours in view, which decide how letters join
  hb_buffer_set_script(buffer.get(), hb_script_t(run.script));
  hb_buffer_set_direction(buffer.get(), run.right_to_left ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
  hb_buffer_set_language(buffer.get(), language_of(hb_script_t(run.script)));
  return shaped_in(fonts, run.face, buffer.get(), line, run.begin);
}

bool has_glyph(const Fonts& fonts, Face face, char32_t character) {
  hb_codepoint_t glyph = 0;
  return hb_font_get_nominal_glyph(fonts.state().entry(face).hb_font, character, &glyph) != 0;
}

double italic_correction(const Fonts& fonts, Face face, std::uint32_t glyph) {
  const Fonts::State::Entry& entry = fonts.state().entry(face);
  return double(hb_ot_math_get_glyph_italics_correction(entry.hb_font, glyph)) / entry.units_per_em;
}

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
  const HbFace source(hb_face_create(whole.get(), unsigned(fonts.index(face))));
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

namespace {

// FreeType's outlines have no end of their own: each is closed where the next begins, and at the end.
struct OutlinePen {
  std::vector<OutlinePiece> pieces;
  double em = 1;

  template <class... Points>
  int add(char kind, const Points*... points) {
    OutlinePiece piece{kind, 0, {}};
    ((piece.points[std::size_t(piece.count++)] = {double(points->x) / em, double(points->y) / em}), ...);
    if (kind == 'M' && !pieces.empty()) pieces.push_back({});
    pieces.push_back(piece);
    return 0;
  }
  static OutlinePen& of(void* user) { return *static_cast<OutlinePen*>(user); }
};

}  // namespace

std::vector<OutlinePiece> outline_of(const Fonts& fonts, Face face, std::uint32_t glyph) {
  Fonts::State::Entry& entry = fonts.state().entry(face);
  const std::lock_guard lock(fonts.state().outlines);
  if (FT_Load_Glyph(entry.ft_face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING) != 0 ||
      entry.ft_face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    throw Error(ExitCode::no_renderer, "a glyph of " + entry.name + " has no outline");
  FT_Outline_Funcs pens{};
  using To = const FT_Vector*;
  pens.move_to = [](To a, void* user) { return OutlinePen::of(user).add('M', a); };
  pens.line_to = [](To a, void* user) { return OutlinePen::of(user).add('L', a); };
  pens.conic_to = [](To a, To b, void* user) { return OutlinePen::of(user).add('Q', a, b); };
  pens.cubic_to = [](To a, To b, To c, void* user) { return OutlinePen::of(user).add('C', a, b, c); };
  OutlinePen pen{{}, entry.units_per_em};
  FT_Outline_Decompose(&entry.ft_face->glyph->outline, &pens, &pen);
  if (!pen.pieces.empty()) pen.pieces.push_back({});
  return std::move(pen.pieces);
}

}  // namespace chainreel
