// All points within a radius of a segment.
layout(location = 0) in vec4 place;  // one end, unit direction to the other
layout(location = 1) in vec4 body;   // length, radius, half stroke
layout(location = 2) in vec4 ends;   // opacity at the two ends
layout(location = 3) in vec4 fill_color;
layout(location = 4) in vec4 stroke_color;

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
  float reach = body.y + body.z + kFringe;
  vec2 local = vec2(0.5 * body.x, 0.0) + quad_corner() * vec2(0.5 * body.x + reach, reach);
  vec2 across = vec2(-place.w, place.z);
  gl_Position = clip_position(place.xy + local.x * place.zw + local.y * across);
}
