// What a clip or picture remembers: the scene that it shows, its audit, and words for those who cannot see it. A
// figure of a model and a contact sheet, which show no scene or many, remember the words that made them.
#pragma once

#include <string>

#include "core/json.hpp"
#include "encode/frame_sink.hpp"
#include "render/vector_shapes.hpp"

namespace chainreel {

// In a figure, and in the record of a table, under this key: what the files of its command said, see command_inputs.
inline constexpr const char* kInputs = "inputs";

struct ClipMemory {
  std::string title;
  std::string description;  // one sentence
  std::string scene;  // YAML of the effective scene; paths as found from its own folder, see clip_origin
  Json audit;         // nothing in it depends on the clock
  // Null, or in place of a scene {arguments, files, model, model_sha256, model_elements_sha256, inputs, poses}; `files` are the indices of those
  // arguments that are paths, as found from the folder of the first.
  Json figure = nullptr;

  double width_mm = 0;  // of the picture on paper; 0: it has no size of its own. Not read back

  Tags tags() const;        // of MP4, MOV, WebM, PNG, APNG, GIF
  VectorPage page() const;  // of SVG (<metadata>) and PDF (keywords)
};

// Reads it back; by the file's ending. Throws Error (exit 3) where the file is of no such kind or remembers
// nothing.
ClipMemory recall(const std::string& path);
// The words of vector pages alone, which are read as a whole.
Tags read_svg_words(const std::string& path);
Tags read_pdf_words(const std::string& path);

// "chainreel ellipse models/rr.urdf --pose 0,90deg": what a shell takes to make the figure again, but for -o.
std::string command_line(const Json& figure);

}  // namespace chainreel
