// Frames that a test makes one by one to a film, in chunks of two seconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "encode/film_chunk.hpp"

namespace chainreel {

class FilmOfFrames final : public FrameSink {
 public:
  FilmOfFrames(const std::string& path, const VideoSettings& settings)
      : settings_(settings), writer_(std::make_unique<FilmWriter>(path, settings)) {}

  using FrameSink::write;
  void write(const Image& frame, const std::vector<PixelBox>& changed) override {
    if (!encoder_) encoder_ = std::make_unique<ChunkEncoder>(settings_);
    encoder_->write(frame, changed);
    if (++frames_ % std::max(1L, std::lround(2 * settings_.fps.value())) == 0) end_chunk();
  }
  void finish() override {
    end_chunk();
    writer_->finish();
  }

 private:
  void end_chunk() {
    if (!encoder_) return;
    encoder_->finish();
    writer_->add(encoder_->take());
    encoder_.reset();
  }

  VideoSettings settings_;
  std::unique_ptr<FilmWriter> writer_;
  std::unique_ptr<ChunkEncoder> encoder_;  // of the chunk that is being made
  long frames_ = 0;
};

}  // namespace chainreel
