// What a film file really holds: every frame decoded, through FFmpeg's libraries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image.hpp"

namespace chainreel {

struct Ratio {
  std::int64_t num = 0;
  std::int64_t den = 1;
  friend bool operator==(const Ratio& a, const Ratio& b) { return a.num * b.den == b.num * a.den; }
};

struct VideoFacts {
  std::string codec;         // "h264"
  std::string profile;       // "High"
  std::string pixel_format;  // "yuv420p", of the frames as decoded
  int width = 0;
  int height = 0;
  Ratio pixel_aspect;
  Ratio fps;                                       // as the container says
  Ratio duration;                                  // of the track, seconds, exact
  Ratio movie_duration;                            // of the whole file, seconds, to the microsecond
  int declared_frames = 0;                         // in the container's index; 0 where it has none
  int frames = 0;                                  // counted by decoding
  std::string primaries, transfer, matrix, range;  // FFmpeg's names: "bt709", ..., "tv"
  bool index_first = false;                        // moov before mdat: plays before it is loaded whole
  std::string alpha_mode;                          // the track's tag by which WebM's players find opacity
  bool regular = false;                            // frame k is shown at k / fps exactly, from 0 on
  std::vector<int> key_frames;                     // frames at which decoding can start
  Image first, middle, last;                       // middle: frame declared_frames / 2
};

// Throws Error (exit 3) where the file cannot be opened or any part of it cannot be decoded.
VideoFacts probe_video(const std::string& path);

// Whether an MP4 can play before it is loaded whole: its box moov stands before mdat.
bool has_index_first(const std::string& path);

}  // namespace chainreel
