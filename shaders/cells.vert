// Flat cells in a rectangle, one texel each.
layout(location = 0) in vec4 place;   // left, top, right, bottom on the page
layout(location = 1) in vec4 counts;  // cells across and down

flat out vec4 rect;
flat out vec2 cells;

void main() {
  rect = place;
  cells = counts.xy;
  gl_Position = clip_position(mix(place.xy - kFringe, place.zw + kFringe, 0.5 * quad_corner() + 0.5));
}
