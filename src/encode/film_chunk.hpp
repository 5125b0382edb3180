// Films in chunks: each becomes a closed group of pictures by an encoder of its own, on one thread, whoever encodes the
// others and wherever; packets are then joined without encoding again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "encode/video_writer.hpp"

namespace chainreel {

struct FilmPacket {
  std::string data;
  std::string opacity;   // what VP9 has of it beside its pictures
  std::int64_t pts = 0;  // which of the chunk's frames it shows
  bool is_key = false;
};

struct FilmChunk {
  int frames = 0;
  std::vector<FilmPacket> packets;  // one a frame, in decoding order
};

// Where the chunks of a film begin, and behind them its number of frames. By the film alone, never by the machine, since
// bytes depend on it: none is longer than two seconds, so that players find key frames there; there are four or a
// multiple of four where they do not get too short, so that two, four or eight cores have equal shares. Where all frames are
// key frames, as in ProRes and in sequences of pictures (no codec), chunks are a few frames.
std::vector<int> chunk_bounds(int frames, FrameRate fps, std::optional<VideoCodec> codec);

// Whether a part of the film that is to be joined must begin and end at those bounds.
bool has_fixed_chunks(VideoCodec codec);

// Chunks to a film.
class FilmWriter {
 public:
  // Writes to `path` as given; the caller renames it when finish() has returned. Throws Error (usage, exit 4: no
  // encoder, 6: cannot be written).
  // `head`: what decoders are to know first, where packets come from a file that has it in its own form, see PacketReader.
  FilmWriter(const std::string& path, const VideoSettings& settings, const std::string& head = {});
  ~FilmWriter();  // a file that is not finished is taken away

  void add(const FilmChunk& chunk);  // in the order of the film
  // The same packet by packet: a chunk's, then how many frames it had.
  void add(const FilmPacket& packet);
  void end_chunk(int frames);
  void finish();  // closes the file; throws Error (exit 3) where there was no frame

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The packets of a film that a FilmWriter wrote, as they stand there.
class PacketReader {
 public:
  // `fps` of the film. Throws Error (exit 3) where the file is no film of ours.
  PacketReader(const std::string& path, FrameRate fps);
  ~PacketReader();
  PacketReader(PacketReader&&) noexcept;

  VideoCodec codec() const;
  const std::string& head() const;
  bool next(FilmPacket& packet);  // in decoding order; false behind the last

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
