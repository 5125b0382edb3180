// What stands behind `Fonts`: the faces as FreeType and HarfBuzz hold them. Internal to this floor.
#pragma once

#include <ft2build.h>
#include <hb.h>
#include FT_FREETYPE_H

#include <array>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "picture/find_font.hpp"
#include "picture/text.hpp"

namespace chainreel {

struct Fonts::State {
  struct Entry {
    std::string name, remedy;  // for messages
    std::string file;
    int index = 0;  // in its file
    hb_blob_t* blob = nullptr;
    hb_font_t* hb_font = nullptr;
    FT_Face ft_face = nullptr;
    double units_per_em = 1;
    std::once_flag hashed;
    std::string sha256;
  };
  // A face that is installed, with the characters that it has once somebody asked.
  struct Candidate {
    InstalledFace face;
    hb_set_t* characters = nullptr;
    std::optional<Face> opened{};
  };

  State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  Entry& entry(Face face);
  // Throws Error (exit 4) where the file is no font.
  void open(Entry& entry, const FontFile& at);

  FT_Library library = nullptr;
  std::array<Entry, kOwnFaces> faces;
  std::mutex outlines;  // loading a glyph writes into the FreeType face

  std::vector<std::string> folders;  // where other faces are looked for
  std::mutex fallback;               // over what follows
  std::deque<Entry> fallbacks;       // opened, by the number of their `Face` behind the own ones
  std::vector<Candidate> candidates; // in the order of their paths, once the first character was missing
  bool has_candidates = false;
};

std::string code_point_name(char32_t c);

}  // namespace chainreel
