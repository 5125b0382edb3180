// Flat cells in a rectangle, one texel each.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 place;   // left, top, right, bottom on the page
layout(location = 2) in vec4 counts;  // cells across and down

flat out vec4 rect;
flat out vec2 cells;

void main() {
  rect = place;
  cells = counts.xy;
  gl_Position = corner_of(window);
}
