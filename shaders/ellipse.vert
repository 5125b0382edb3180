layout(location = 0) in vec4 window;
layout(location = 1) in vec4 place;  // centre, unit direction of the major axis
layout(location = 2) in vec4 body;   // major and minor semi-axis, half stroke
layout(location = 3) in vec4 stroke_color;
layout(location = 4) in vec4 fill_color;
layout(location = 5) in vec4 fade_slopes;
layout(location = 6) in vec4 fade_offsets;

flat out vec4 frame;
flat out vec3 size;
flat out vec4 fill;
flat out vec4 stroke;
flat out vec4 slopes;
flat out vec4 offsets;

void main() {
  frame = place;
  size = body.xyz;
  fill = fill_color;
  stroke = stroke_color;
  slopes = fade_slopes;
  offsets = fade_offsets;
  gl_Position = corner_of(window);
}
