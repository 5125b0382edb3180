// A convex polygon of eight corners in the sense of growing angle (y down); fewer are filled up with
// points on an edge.
layout(location = 0) in vec4 corners_01;
layout(location = 1) in vec4 corners_23;
layout(location = 2) in vec4 corners_45;
layout(location = 3) in vec4 corners_67;
layout(location = 4) in vec4 body;  // half stroke
layout(location = 5) in vec4 fill_color;
layout(location = 6) in vec4 stroke_color;

flat out vec4 c01, c23, c45, c67;
flat out float half_stroke;
flat out vec4 fill;
flat out vec4 stroke;

void main() {
  c01 = corners_01;
  c23 = corners_23;
  c45 = corners_45;
  c67 = corners_67;
  half_stroke = body.x;
  fill = fill_color;
  stroke = stroke_color;
  vec4 low = min(min(corners_01, corners_23), min(corners_45, corners_67));
  vec4 high = max(max(corners_01, corners_23), max(corners_45, corners_67));
  vec2 low_corner = min(low.xy, low.zw) - body.x - kFringe;
  vec2 high_corner = max(high.xy, high.zw) + body.x + kFringe;
  gl_Position = clip_position(mix(low_corner, high_corner, 0.5 * quad_corner() + 0.5));
}
