// Parts of a film that are rendered apart, on whichever machine, and joined: which frames a part has, and what it tells of
// itself so that no wrong ones are put together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "draw/film/film.hpp"
#include "encode/video_writer.hpp"
#include "app/film/clip_memory.hpp"
#include "app/film/prepared.hpp"

namespace chainreel {

// Frames as they are shown, from the first to the one behind the last.
struct FrameRange {
  int first = 0, behind = 0;
  bool empty() const { return first >= behind; }
};

// What is to be rendered of a film: given frames, or an equal share of its chunks.
class PartRequest {
 public:
  // "A:B" of --frames; "k/n" of --shard, or "slurm": of the array job whose task this is, by its environment. Throw Error
  // (usage).
  static PartRequest of_frames(const std::string& text);
  static PartRequest of_shard(const std::string& text);

  // What the part's file has before its ending: ".part-000000-000075", ".part-3-of-8".
  std::string suffix() const;
  std::string text() const;    // for people: "frames 0:75", "shard 3/8"

  // Share of so many equal things. Of a request by --shard.
  FrameRange of_things(int count) const;

  // Of a film of so many frames, whose chunks begin at `bounds`. `is_fixed`: parts must begin and end there. A share may
  // be empty. Throws Error (usage) with the nearest frames that are possible.
  FrameRange of(const std::vector<int>& bounds, bool is_fixed) const;

 private:
  bool is_shard_ = false;
  int first_ = 0, second_ = 0;  // frames; or which share of how many
};

// What a part says of itself beside what a film does.
struct PartFacts {
  FrameRange range;
  int frames = 0;  // of the whole film
  VideoSettings settings;
  std::string film_sha256, program;
  std::vector<std::string> libraries;  // that drew and encoded it, see libraries_behind
  Json audit;                  // NAME.json of the film, without what depends on the clock
  std::string words, captions;  // NAME.txt, NAME.srt
};
Json to_json(const PartFacts& part);
// Throws Error (exit 3) where the file at `path`, which says this, is no part or its facts are spoilt.
PartFacts part_facts(const std::string& text, const std::string& path);

// A part bears a hash of its bytes at its end, in a box that players pass over: what was changed or cut off since is not
// joined. `target` is named in errors (exit 6); require_sealed throws Error (exit 3).
void seal_part(const std::string& path, const std::string& target);
void require_sealed(const std::string& path);

inline constexpr const char* kPart = "chainreel_part";

inline constexpr const char* kMeshesHash = "meshes_sha256";  // in the audits of films that show meshes

// Of the meshes of all panels; "" where there are none.
std::string meshes_hash(const PreparedFilm& film);

// The builds of encoders, and what renders: parts and chunks by others are not joined, whatever versions these tell of.
std::vector<std::string> libraries_behind(const Fonts& fonts);
// Whether they make the same bytes: pages that llvmpipe draws are those that are filled without OpenGL.
bool are_alike(const std::vector<std::string>& libraries, const std::vector<std::string>& others);

// Of all that the film's pictures depend on but what draws and encodes them: its memory, which holds hashes of models, meshes and
// motions, and fonts.
std::string film_hash(const ClipMemory& memory, const Fonts& fonts);

}  // namespace chainreel
