// Which installed face stands in for characters that another lacks: decided by names, weights and paths of what is installed
// and by the characters, never by fontconfig, whose answers hang on its configuration, nor by what was asked before.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <tuple>

#include "core/error.hpp"
#include "core/format.hpp"
#include "picture/fonts_state.hpp"
#include "picture/shaping.hpp"

namespace chainreel {
namespace {

using Candidate = Fonts::State::Candidate;

bool is_within(char32_t c, char32_t first, char32_t last) {
  return c >= first && c <= last;
}

bool is_control(char32_t c) {
  return c < 0x20 || is_within(c, 0x7F, 0x9F) || c == 0x2028 || c == 0x2029;
}

bool is_of_east_asia(hb_script_t script) {
  return script == HB_SCRIPT_HAN || script == HB_SCRIPT_HIRAGANA || script == HB_SCRIPT_KATAKANA || script == HB_SCRIPT_HANGUL ||
         script == HB_SCRIPT_BOPOMOFO;
}

// Debian's package with glyphs of it.
const char* package_with(char32_t c, hb_script_t script) {
  if (is_of_east_asia(script) || is_within(c, 0x3000, 0x303F) || is_within(c, 0xFF00, 0xFFEF)) return "fonts-noto-cjk";
  if (c >= 0x1F000) return script == HB_SCRIPT_COMMON ? "fonts-symbola" : "fonts-noto-cjk";
  return script == HB_SCRIPT_COMMON ? "fonts-symbola" : "fonts-noto-core";
}

[[noreturn]] void refuse(char32_t c, std::u32string_view line) {
  const std::string where = " in '" + encode_utf8(line) + "'";
  if (is_control(c))
    throw Error(ExitCode::no_renderer, code_point_name(c) + where + " is a control character, which no font shows: leave it out");
  const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), c);
  const hb_unicode_general_category_t kind = hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
  if (kind == HB_UNICODE_GENERAL_CATEGORY_PRIVATE_USE || kind == HB_UNICODE_GENERAL_CATEGORY_UNASSIGNED)
    throw Error(ExitCode::no_renderer, "no installed font has a glyph for " + code_point_name(c) + where +
                                           ", which Unicode gives no meaning: leave it out, or install a font (.ttf, .otf) that has it in " +
                                           "/usr/local/share/fonts");
  throw Error(ExitCode::no_renderer, "no installed font has a glyph for " + code_point_name(c) + where +
                                         ": install the Debian package " + package_with(c, script));
}

// Families of Chinese, Japanese and Korean glyphs of the same characters are told by the end of their names.
const char* region_of(std::u32string_view line) {
  bool has_han = false;
  for (const char32_t c : line) {
    const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), c);
    if (script == HB_SCRIPT_HIRAGANA || script == HB_SCRIPT_KATAKANA) return " JP";
    if (script == HB_SCRIPT_HANGUL) return " KR";
    has_han = has_han || script == HB_SCRIPT_HAN;
  }
  return has_han ? " SC" : "";
}

// Lower is better: sans serif as the program's own, of the wanted weight and normal width.
auto rank_of(const InstalledFace& face, bool is_bold, const std::string& region) {
  const auto has = [&](const char* word) { return face.family.find(word) != std::string::npos; };
  const int kind = has("Mono") || has("Unifont") ? 2 : has("Sans") ? 0 : 1;
  const bool is_elsewhere = !region.empty() && !face.family.ends_with(region);
  return std::tuple(kind, is_elsewhere, std::abs(face.width - 5), std::abs(face.weight - (is_bold ? 700 : 400)));
}

bool has(Candidate& candidate, char32_t c) {
  if (candidate.characters == nullptr) {
    candidate.characters = hb_set_create();
    hb_blob_t* blob = hb_blob_create_from_file(candidate.face.at.file.c_str());
    hb_face_t* face = hb_face_create(blob, unsigned(candidate.face.at.index));
    hb_face_collect_unicodes(face, candidate.characters);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
  }
  return hb_set_has(candidate.characters, c) != 0;
}

Face opened(Fonts::State& state, Candidate& candidate) {
  if (!candidate.opened) {
    Fonts::State::Entry& entry = state.fallbacks.emplace_back();
    entry.name = candidate.face.family;
    try {
      state.open(entry, candidate.face.at);
    } catch (...) {
      state.fallbacks.pop_back();
      throw;
    }
    candidate.opened = Face(kOwnFaces + int(state.fallbacks.size()) - 1);
  }
  return *candidate.opened;
}

}  // namespace

std::vector<Face> fallbacks_for(const Fonts& fonts, Face face, std::u32string_view characters, std::u32string_view line) {
  // Some fonts have glyphs for them, which mean nothing.
  if (const auto control = std::find_if(characters.begin(), characters.end(), is_control); control != characters.end())
    refuse(*control, line);
  Fonts::State& state = fonts.state();
  const std::lock_guard lock(state.fallback);
  if (!state.has_candidates) {
    for (InstalledFace& one : installed_faces(state.library, state.folders)) state.candidates.push_back({std::move(one)});
    state.has_candidates = true;
  }
  std::vector<Candidate*> order;
  for (Candidate& one : state.candidates) order.push_back(&one);
  const std::string region = region_of(line);
  std::stable_sort(order.begin(), order.end(), [&](const Candidate* a, const Candidate* b) {
    return rank_of(a->face, face == Face::label_bold, region) < rank_of(b->face, face == Face::label_bold, region);
  });

  const auto has_all = [&](Candidate* one) {
    return std::all_of(characters.begin(), characters.end(), [&](char32_t c) { return has(*one, c); });
  };
  if (const auto one = std::find_if(order.begin(), order.end(), has_all); one != order.end())
    return std::vector<Face>(characters.size(), opened(state, **one));
  std::vector<Face> faces;
  for (const char32_t c : characters) {
    const auto one = std::find_if(order.begin(), order.end(), [&](Candidate* each) { return has(*each, c); });
    if (one == order.end()) refuse(c, line);
    faces.push_back(opened(state, **one));
  }
  return faces;
}

std::vector<Face> Fonts::fallbacks() const {
  const std::lock_guard lock(state_->fallback);
  std::vector<Face> faces;
  for (const Candidate& one : state_->candidates)
    if (one.opened) faces.push_back(*one.opened);
  return faces;
}

}  // namespace chainreel
