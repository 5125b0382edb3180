// A piece of a path, drawn into a layer of its own that keeps the largest value, so that pieces may overlap.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 ends;
layout(location = 2) in vec4 body;  // half width at the two ends, opacity at the two ends

flat out vec4 piece;
flat out vec4 size;

void main() {
  piece = ends;
  size = body;
  gl_Position = corner_of(window);
}
