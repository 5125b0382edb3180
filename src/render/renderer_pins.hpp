// What Mesa's software renderer reads from the environment and the bytes of a picture hang on. It is set inside the program,
// before a library of Mesa's is opened, so that every x86-64 processor draws the same bytes:
//
// - The instructions that shaders are compiled for, one of two sets: up to AVX, or up to SSE 4.1 where there is no AVX. Places
//   of vertices, and what is interpolated between them, are computed by fused multiply-adds where the processor has such,
//   whatever shaders say. Here this changes no byte: windows have corners on whole pixels, to which Mesa rounds, and nothing is
//   interpolated; what shaders themselves compute is never fused. More than AVX would bring little, and more kinds of code.
// - The width of vectors, that which belongs to these instructions: of any other, code may come out of Mesa's cache of
//   shaders that was compiled for this one, and crashes.
// - Switches for developers of Mesa, which leave parts of a picture out, draw it as wires, by other code or never to an end. There
//   are hundreds, so that whole families of names are cleared.
#pragma once

#include <span>

namespace chainreel {

struct RendererPin {
  const char* name;   // with * at its end: all that begin so, but those that are set here or change no byte
  const char* value;  // null: must not be set
};

std::span<const RendererPin> renderer_pins();

// Sets and clears, once, all of the environment that this program sets and clears for itself and what it starts. To be called
// before the first thread of the process, as others may be reading the environment; later calls change nothing.
void settle_environment();

}  // namespace chainreel
