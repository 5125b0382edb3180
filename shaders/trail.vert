// A piece of a path, drawn into a layer of its own that keeps the largest value, so that pieces may overlap.
layout(location = 0) in vec4 ends;
layout(location = 1) in vec4 body;  // half width at the two ends, opacity at the two ends

flat out vec4 piece;
flat out vec4 size;

void main() {
  piece = ends;
  size = body;
  // The box around the piece: pieces are short, and it needs no unit vector.
  float reach = max(body.x, body.y) + kFringe;
  vec2 low = min(ends.xy, ends.zw) - reach;
  vec2 high = max(ends.xy, ends.zw) + reach;
  gl_Position = clip_position(mix(low, high, 0.5 * quad_corner() + 0.5));
}
