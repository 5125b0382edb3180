// A film whose chunks come in any order, from several threads.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "encode/film_chunk.hpp"

namespace chainreel {

class JoinedFilm {
 public:
  // See FilmWriter.
  JoinedFilm(const std::string& path, const VideoSettings& settings) : settings_(settings), writer_(path, settings) {}

  const VideoSettings& settings() const { return settings_; }

  // Writes what stands in its place, and keeps the others until those before them have come.
  void take(std::size_t index, FilmChunk chunk) {
    const std::lock_guard guard(lock_);
    waiting_.emplace(index, std::move(chunk));
    for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
      writer_.add(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
  }

  void finish() { writer_.finish(); }

 private:
  VideoSettings settings_;
  std::mutex lock_;
  FilmWriter writer_;
  std::map<std::size_t, FilmChunk> waiting_;
  std::size_t next_ = 0;
};

}  // namespace chainreel
