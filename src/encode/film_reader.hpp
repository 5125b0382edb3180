// Films read back frame by frame: MP4, MOV, WebM, GIF and APNG.
#pragma once

#include <memory>
#include <string>

#include "core/image.hpp"

namespace chainreel {

class FilmReader {
 public:
  // Throws Error (exit 3) where the file is no such film or cannot be decoded here.
  explicit FilmReader(const std::string& path);
  ~FilmReader();
  FilmReader(FilmReader&&) noexcept;
  FilmReader& operator=(FilmReader&&) noexcept;

  double seconds() const;  // of the film, as its file says; 0 where it does not
  double fps() const;      // frames a second, as its file says; 0 where it does not
  std::string container() const;  // FFmpeg's name of it, or some with commas between: "gif", "matroska,webm"
  int width() const;       // of the last frame, pixels
  int height() const;
  double time() const;  // s from the first frame to the last that was read

  // The next frame as a player would show it, with its opacity; where it is wider than `widest`, scaled down
  // to that. False behind the last. Throws Error (exit 3) where a frame cannot be decoded.
  bool next(Image& image, int widest = 1 << 20);

  // Likewise the frame that is shown `seconds` from the first on, or the last one. Of what lies before it only what it is
  // coded from is decoded. False where the film has no frame. The last thing that a reader is asked.
  bool find(double seconds, Image& image, int widest = 1 << 20);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chainreel
