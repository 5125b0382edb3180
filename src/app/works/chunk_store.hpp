// Chunks of a film that are finished, kept in a hidden folder beside the film until it is whole: a render that was killed
// goes on from there, with the same bytes.
#pragma once

#include <optional>
#include <string>

#include "encode/film_chunk.hpp"

namespace chainreel {

class ChunkStore {
 public:
  // `key`: of all that the chunks depend on, 64 hexadecimal digits; chunks of another one are removed. Throws Error (exit
  // 6) where the folder cannot be made, or where another process is at it.
  ChunkStore(const std::string& film, std::string key);
  ~ChunkStore();
  ChunkStore(const ChunkStore&) = delete;
  ChunkStore& operator=(const ChunkStore&) = delete;

  // That of frames first .. behind - 1, if it is there and whole. Several threads may ask and keep at a time.
  std::optional<FilmChunk> find(int first, int behind) const;
  // Throws Error (exit 6).
  void keep(int first, int behind, const FilmChunk& chunk) const;
  // The film is whole: nothing stays of what any run kept for it, unless another process is at it.
  static void forget(const std::string& film);

 private:
  std::string path_of(int first, int behind) const;

  std::string film_, folder_, key_;
  int lock_ = -1;
};

}  // namespace chainreel
