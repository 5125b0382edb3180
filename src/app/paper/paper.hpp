// The size of a picture on paper, of commands that make figures: --width-mm, --height-mm, --dpi. Nothing that is written at
// its usual size is then smaller than a paper's figure may say; indices in formulas are 0.7 times as large as their letters.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "core/json.hpp"
#include "scene/scene.hpp"

namespace chainreel {

struct PaperOptions {
  static constexpr double kNotGiven = -1;
  double width_mm = kNotGiven, height_mm = kNotGiven;
  int dpi = 0;  // of a .png; 0: 300

  bool is_given() const { return width_mm != kNotGiven; }
};

// As a picture remembers it in its audit, and back; of one that is not for paper, null and nothing given.
inline constexpr const char* kPaper = "paper";
Json to_json(const PaperOptions& options);
PaperOptions paper_of(const Json& json);
// The flags that give it.
std::vector<std::string> paper_flags(const PaperOptions& options);

// `default_height`: in words.
void add_paper_options(Command& command, PaperOptions& options, const std::string& default_height);

// Throws Error (usage) of sizes beyond reason, and of those that do not go together; `in_pixels`: --width or --height is given.
void check_paper(const PaperOptions& options, bool in_pixels);

struct PaperPage {
  double width_mm = 0;
  int width = 0, height = 0;  // px
  double least_text = 0;      // units of H, of the smallest word: 7 pt
};
// `height_mm`: where the options name none. Throws Error (usage) of too many pixels.
PaperPage paper_page(const PaperOptions& options, double height_mm);

// mm: the tallest that has not too many pixels.
double tallest_page(const PaperOptions& options);

void give_size(Video& video, const PaperPage& page);

// The scale of text at which its smallest is as large, at least 1.
double text_scale_on(const PaperPage& page, double text_scale);

}  // namespace chainreel
