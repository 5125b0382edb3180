// One picture with every primitive in typical and extreme forms.
#pragma once

#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

Picture test_card(const Fonts& fonts, const Theme& theme);

}  // namespace chainreel
