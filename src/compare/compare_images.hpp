// Two pictures of one size: which pixels differ, which of these are anti-aliasing, and how much of the rest
// an eye sees. The error is that of `compare/flip`; an alpha that differs counts as an error of at least its
// difference. What is masked, and what lies at edges, is taken as equal before errors are computed, so that
// it does not bear on its neighbours'.
#pragma once

#include <vector>

#include "compare/envelope.hpp"
#include "core/pixel_box.hpp"
#include "core/image.hpp"

namespace chainreel {

struct ImageTolerance {
  double error = 0.1;             // a pixel counts as different where its error (0 to 1) is beyond this ..
  int pixels = 0;                 // .. and so many may
  std::vector<PixelBox> masks{};  // not looked at; they may reach out of the picture
  // Where there is no envelope, that of each pixel's neighbours is taken (`envelope_of` without shapes).
  bool forgive_edges = false;
};

struct ImageDifference {
  bool same_size = true;  // else nothing else is known
  long unequal = 0;       // pixels of another value
  long at_edges = 0;      // of these, within the envelope: anti-aliasing
  long beyond = 0;        // of the others, those whose error is beyond the tolerance
  double worst = 0;       // largest error of the unequal ones that are not at edges
  double mean = 0;        // mean error over the whole picture
  PixelBox box;           // around those beyond; around all unequal where none is

  bool is_equal() const { return same_size && unequal == 0; }
  bool passes(const ImageTolerance& tolerance) const { return same_size && beyond <= tolerance.pixels; }
};

ImageDifference compare_images(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                               const Envelope* envelope = nullptr);

// The actual picture in pale grey, what differs on it: in pale blue at edges, faint within the tolerance,
// strong beyond it, on magma's scale from orange to near black the larger the error is; what is masked is
// hatched. Empty where the sizes differ.
Image difference_picture(const Image& expected, const Image& actual, const ImageTolerance& tolerance,
                         const Envelope* envelope = nullptr);

}  // namespace chainreel
