layout(location = 0) in vec4 window;
layout(location = 1) in vec4 place;  // centre, unit direction to the middle of the arc
layout(location = 2) in vec4 body;   // radius, half width, sine and cosine of half the sweep
layout(location = 3) in vec4 paint_color;

flat out vec4 frame;
flat out vec4 shape;
flat out vec4 fill;

void main() {
  frame = place;
  shape = body;
  fill = paint_color;
  gl_Position = corner_of(window);
}
