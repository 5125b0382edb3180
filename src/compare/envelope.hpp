// What anti-aliasing may make of a picture's pixels.
#pragma once

#include <span>

#include "core/image.hpp"

namespace chainreel {

// Lowest and highest value of each channel that a picture may have where its shapes lie within half a pixel
// of where they are; and the same of the means over 3 x 3 pixels, so that a stroke which is thinner than a
// pixel, and which each pixel alone could lack, cannot be missing from all.
struct Envelope {
  Image low, high;
  Image mean_low, mean_high;
};

// From one rendering and others whose shapes are moved by half a pixel; four, to each side, stand for all
// moves with |dx| + |dy| <= 0.5. Between them values are taken to be as steep as the renderings show at the
// pixel, since a thin stroke may have its peak there. All are of one size, else
// std::logic_error is thrown.
Envelope envelope_of(const Image& drawn, std::span<const Image> moved);

// Without shapes: half way to each pixel's neighbours. That is less than half a pixel's move of a sharp edge,
// some quarter of a pixel's.
Envelope envelope_of(const Image& drawn);

// What `is_within(envelope_of(drawn), actual, x, y)` asks of the pixel itself, without an envelope: where
// this is false, that is.
bool is_near_neighbours(const Image& drawn, const Image& actual, int x, int y);

// Whether `actual` may have this pixel by anti-aliasing alone, to 1/255; its surroundings by an eighth of
// their contrast more, since renderers differ in how much of a thin stroke they see.
bool is_within(const Envelope& envelope, const Image& actual, int x, int y);

}  // namespace chainreel
