// Words on several lines that are laid out as one.
#pragma once

#include <string>

#include "picture/text.hpp"

namespace chainreel {

inline constexpr double kLeading = 1.3;  // em from line to line

// On as few lines as the width needs, about equally long.
TextLine lay_out_within(const Fonts& fonts, const std::string& text, const TextStyle& style, double width);

}  // namespace chainreel
