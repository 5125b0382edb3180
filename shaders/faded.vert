// A part of a shape that it fills evenly but for its fading towards edges.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 fill_color;
layout(location = 2) in vec4 fade_slopes;
layout(location = 3) in vec4 fade_offsets;

flat out vec4 fill;
flat out vec4 slopes;
flat out vec4 offsets;

void main() {
  fill = fill_color;
  slopes = fade_slopes;
  offsets = fade_offsets;
  gl_Position = corner_of(window);
}
