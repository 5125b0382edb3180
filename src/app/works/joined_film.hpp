// A film whose chunks come in any order, from several threads.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "app/works/chunk_store.hpp"
#include "encode/film_chunk.hpp"

namespace chainreel {

class JoinedFilm {
 public:
  // See FilmWriter. `store`: where finished chunks are kept, or null.
  JoinedFilm(const std::string& path, const VideoSettings& settings, std::shared_ptr<const ChunkStore> store)
      : settings_(settings), store_(std::move(store)), writer_(path, settings) {}

  const VideoSettings& settings() const { return settings_; }
  const ChunkStore* store() const { return store_.get(); }  // null where nothing is kept

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
  std::shared_ptr<const ChunkStore> store_;
  std::mutex lock_;
  FilmWriter writer_;
  std::map<std::size_t, FilmChunk> waiting_;
  std::size_t next_ = 0;
};

}  // namespace chainreel
