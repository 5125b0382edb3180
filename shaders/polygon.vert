// A convex polygon of eight corners in the sense of growing angle (y down); fewer are filled up with
// points on an edge.
layout(location = 0) in vec4 window;
layout(location = 1) in vec4 corners_01;
layout(location = 2) in vec4 corners_23;
layout(location = 3) in vec4 corners_45;
layout(location = 4) in vec4 corners_67;
layout(location = 5) in vec4 body;  // half stroke
layout(location = 6) in vec4 stroke_color;
layout(location = 7) in vec4 fill_color;
layout(location = 8) in vec4 fade_slopes;
layout(location = 9) in vec4 fade_offsets;

flat out vec4 c01, c23, c45, c67;
flat out float half_stroke;
flat out vec4 fill;
flat out vec4 stroke;
flat out vec4 slopes;
flat out vec4 offsets;

void main() {
  c01 = corners_01;
  c23 = corners_23;
  c45 = corners_45;
  c67 = corners_67;
  half_stroke = body.x;
  fill = fill_color;
  stroke = stroke_color;
  slopes = fade_slopes;
  offsets = fade_offsets;
  gl_Position = corner_of(window);
}
