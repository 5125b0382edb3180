// All points within a radius of a segment.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 place;  // one end, unit direction to the other
layout(location = 2) in vec4 body;   // length, radius, half stroke
layout(location = 3) in vec4 ends;   // opacity at the two ends
layout(location = 4) in vec4 fill_color;
layout(location = 5) in vec4 stroke_color;

flat out vec4 axis;
flat out vec3 size;
flat out vec2 alpha;
flat out vec4 fill;
flat out vec4 stroke;

void main() {
  axis = place;
  size = body.xyz;
  alpha = ends.xy;
  fill = fill_color;
  stroke = stroke_color;
  gl_Position = corner_of(window);
}
