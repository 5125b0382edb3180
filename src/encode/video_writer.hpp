// Frames to what a film is made of: constant frame rate, BT.709 limited range and tagged, closed GOPs of at most 2 s:
//
//   h264    MP4, High, yuv420p, x264 at fixed quantisers by CRF (18), which passes over blocks that are as they were, index first;
//           the stream depends neither on the processor nor on its number of cores; without loss at CRF 0, then High
//           4:4:4 Predictive
//   vp9     WebM, yuv420p or yuva420p, libvpx CRF 28
//   prores  MOV, 4444, 10 bits, all frames key frames, at a fixed quantiser
//
// Opacity is straight in all of them; transparent pixels bear the colours of their surroundings, so that
// edges keep their colour.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_rate.hpp"
#include "core/stage_clock.hpp"
#include "encode/frame_sink.hpp"

namespace chainreel {

enum class VideoCodec { h264, vp9, prores };

struct VideoSettings {
  int width = 1920;
  int height = 1080;
  FrameRate fps{};
  std::optional<double> crf{};  // 0 best to 51 (h264) or 63 (vp9), rounded; absent: 18 and 28; prores has none
  VideoCodec codec = VideoCodec::h264;
  bool alpha = false;  // vp9 and prores alone
  Tags tags{};
};

// The quality that holds: the settings' own or the codec's, a whole number, as encoders take it.
double crf_of(const VideoSettings& settings);
bool has_crf(VideoCodec codec);

// Throws Error (usage) with the two nearest legal sizes where a side is odd: 4:2:0 needs even sides.
void require_even_sides(int width, int height);
// The same for everything in the settings.
void require_settings(const VideoSettings& settings);

struct FilmChunk;

// A chunk's frames as its encoder takes them, kept in memory: to encode them with nothing before it.
class ChunkTape {
 public:
  ChunkTape();
  ~ChunkTape();
  ChunkTape(ChunkTape&&) noexcept;
  ChunkTape& operator=(ChunkTape&&) noexcept;

  int frames() const;
  static double bytes_of_frame(const VideoSettings& settings);

 private:
  friend class ChunkEncoder;
  friend void encode_by_preset(const std::vector<ChunkTape>&, const VideoSettings&, int);
  struct State;
  std::unique_ptr<State> state_;
};

// All of a film by one encoder of H.264 as other programs have it: x264's preset veryfast and the quality, so many threads of
// its own, packets thrown away.
void encode_by_preset(const std::vector<ChunkTape>& tapes, const VideoSettings& settings, int threads);

// Frames to a chunk of a film, see film_chunk.
class ChunkEncoder final : public FrameSink {
 public:
  // Throws Error (usage, exit 4: no encoder).
  // `tape`: takes the frames, which are then not encoded.
  explicit ChunkEncoder(const VideoSettings& settings, ChunkTape* tape = nullptr);
  ~ChunkEncoder() override;

  using FrameSink::write;
  // Of exactly the size in the settings.
  void write(const Image& frame, const std::vector<PixelBox>& changed) override;
  void play(const ChunkTape& tape);  // writes all that is there, made with the same settings
  void finish() override;            // flushes the encoder
  FilmChunk take();                  // once it is finished
  StageTime conversion() const;      // what frames took to become the encoder's, on the threads that wrote them

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
