// A line cut into pieces of one face, script and direction, in the order in which they are seen: Unicode's bidirectional
// algorithm (UAX #9) by FriBidi, scripts by UAX #24 as HarfBuzz knows them.
#include <fribidi/fribidi.h>
#include <hb.h>

#include <algorithm>

#include "core/error.hpp"
#include "picture/fonts_state.hpp"
#include "picture/shaping.hpp"

namespace chainreel {
namespace {

constexpr char32_t kFirstBeyondEurope = 0x0590;  // below lie Latin, Greek, Cyrillic, Armenian and marks on them

hb_script_t script_of(char32_t c) {
  return hb_unicode_script(hb_unicode_funcs_get_default(), c);
}

// Letters that stand one behind another as they are, each by itself.
bool is_simple(hb_script_t script) {
  switch (script) {
    case HB_SCRIPT_LATIN:
    case HB_SCRIPT_GREEK:
    case HB_SCRIPT_CYRILLIC:
    case HB_SCRIPT_ARMENIAN:
    case HB_SCRIPT_GEORGIAN:
    case HB_SCRIPT_HAN:
    case HB_SCRIPT_HIRAGANA:
    case HB_SCRIPT_KATAKANA:
    case HB_SCRIPT_BOPOMOFO:
    case HB_SCRIPT_HANGUL:
    case HB_SCRIPT_COMMON:
    case HB_SCRIPT_INHERITED:
    case HB_SCRIPT_UNKNOWN: return true;
    default: return false;
  }
}

// Scripts that a face of Latin letters has as a whole or not at all: what is missing of them are single signs.
bool is_european(hb_script_t script) {
  return script == HB_SCRIPT_LATIN || script == HB_SCRIPT_GREEK || script == HB_SCRIPT_CYRILLIC || script == HB_SCRIPT_COMMON ||
         script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

bool is_shared(hb_script_t script) {
  return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

// What stands on or joins its neighbours: marks, joiners, selectors of variants.
bool clings(char32_t c) {
  switch (hb_unicode_general_category(hb_unicode_funcs_get_default(), c)) {
    case HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK:
    case HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK:
    case HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK:
    case HB_UNICODE_GENERAL_CATEGORY_FORMAT: return true;
    default: return false;
  }
}

// Tells how others stand and is nothing itself.
bool is_unseen(char32_t c) {
  return hb_unicode_general_category(hb_unicode_funcs_get_default(), c) == HB_UNICODE_GENERAL_CATEGORY_FORMAT;
}

bool turns(char32_t c) {
  const FriBidiCharType type = fribidi_get_bidi_type(c);
  return FRIBIDI_IS_RTL(type) || FRIBIDI_IS_EXPLICIT_OR_BN(type) || FRIBIDI_IS_ISOLATE(type);
}

// Of each character; those that many scripts share belong to what stands before them, at the beginning to what follows.
std::vector<hb_script_t> scripts_of(std::u32string_view line) {
  std::vector<hb_script_t> scripts;
  for (const char32_t c : line) {
    const hb_script_t script = script_of(c);
    scripts.push_back(is_shared(script) && !scripts.empty() ? scripts.back() : script);
  }
  const auto first = std::find_if(scripts.begin(), scripts.end(), [](hb_script_t s) { return !is_shared(s); });
  if (first != scripts.end()) std::fill(scripts.begin(), first, *first);
  return scripts;
}

std::vector<FriBidiLevel> levels_of(std::u32string_view line) {
  const auto count = FriBidiStrIndex(line.size());
  const std::vector<FriBidiChar> text(line.begin(), line.end());
  std::vector<FriBidiCharType> types(line.size());
  std::vector<FriBidiBracketType> brackets(line.size());
  std::vector<FriBidiLevel> levels(line.size());
  fribidi_get_bidi_types(text.data(), count, types.data());
  fribidi_get_bracket_types(text.data(), count, types.data(), brackets.data());
  FriBidiParType direction = FRIBIDI_PAR_ON;  // of the first letter that has one
  if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), count, &direction, levels.data()) == 0)
    throw Error(ExitCode::limit, "no memory for the order of a line's words");
  return levels;
}

// Of the characters from `begin` on, which share script and level.
void find_faces(const Fonts& fonts, Face face, std::u32string_view line, std::size_t begin, std::size_t end, hb_script_t script,
                std::vector<Face>& faces) {
  std::u32string missing;
  const bool whole = !is_european(script);  // of a word in another script no letter is set in the first face
  bool lacks = false;
  for (std::size_t i = begin; i < end; ++i) lacks = lacks || (line[i] != kObject && !clings(line[i]) && !has_glyph(fonts, face, line[i]));
  for (std::size_t i = begin; i < end; ++i) faces[i] = face;
  if (!lacks) return;
  std::vector<std::size_t> places;
  for (std::size_t i = begin; i < end; ++i) {
    if (line[i] == kObject || is_unseen(line[i]) || (clings(line[i]) && i > begin)) continue;
    if (has_glyph(fonts, face, line[i]) && !(whole && !is_shared(script_of(line[i])))) continue;
    places.push_back(i);
    missing += line[i];
  }
  // Marks decide with their letters where they can.
  std::u32string with_marks = missing;
  for (std::size_t i = begin; i < end; ++i)
    if (whole && script_of(line[i]) == script && clings(line[i])) with_marks += line[i];
  const std::vector<Face> found = fallbacks_for(fonts, face, with_marks, line);
  for (std::size_t k = 0; k < places.size(); ++k) faces[places[k]] = found[k];
  for (std::size_t i = begin + 1; i < end; ++i)
    if (clings(line[i])) faces[i] = faces[i - 1];
  // A space between two words of one face is theirs.
  for (std::size_t i = begin + 1; i + 1 < end; ++i)
    if (line[i] == U' ' && faces[i - 1] == faces[i + 1] && has_glyph(fonts, faces[i - 1], U' ')) faces[i] = faces[i - 1];
}

}  // namespace

bool is_plain(const Fonts& fonts, Face face, std::u32string_view text) {
  return std::all_of(text.begin(), text.end(), [&](char32_t c) {
    if (c >= kFirstBeyondEurope && (turns(c) || !is_simple(script_of(c)))) return false;
    return has_glyph(fonts, face, c);
  });
}

std::vector<TextRun> runs_of(const Fonts& fonts, Face face, std::u32string_view line) {
  if (line.empty()) return {};
  const std::vector<hb_script_t> scripts = scripts_of(line);
  const std::vector<FriBidiLevel> levels = levels_of(line);
  std::vector<Face> faces(line.size(), face);
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
    while (end < line.size() && scripts[end] == scripts[begin] && levels[end] == levels[begin]) ++end;
    find_faces(fonts, face, line, begin, end, scripts[begin], faces);
  }

  std::vector<TextRun> runs;
  std::vector<FriBidiLevel> run_levels;
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
    const auto same = [&](std::size_t i) {
      return scripts[i] == scripts[begin] && levels[i] == levels[begin] && faces[i] == faces[begin] && line[i] != kObject;
    };
    for (end = begin + 1; line[begin] != kObject && end < line.size() && same(end);) ++end;
    runs.push_back({begin, end, faces[begin], std::uint32_t(scripts[begin]), levels[begin] % 2 == 1, !is_simple(scripts[begin])});
    run_levels.push_back(levels[begin]);
  }

  // Rule L2: from the highest level down to the lowest odd one, what lies at that level or above is turned about.
  const FriBidiLevel highest = *std::max_element(run_levels.begin(), run_levels.end());
  for (FriBidiLevel level = highest; level > 0; --level)
    for (std::size_t begin = 0; begin < runs.size(); ++begin) {
      std::size_t end = begin;
      while (end < runs.size() && run_levels[end] >= level) ++end;
      if (end == begin) continue;
      std::reverse(runs.begin() + std::ptrdiff_t(begin), runs.begin() + std::ptrdiff_t(end));
      std::reverse(run_levels.begin() + std::ptrdiff_t(begin), run_levels.begin() + std::ptrdiff_t(end));
      begin = end;
    }
  return runs;
}

}  // namespace chainreel
