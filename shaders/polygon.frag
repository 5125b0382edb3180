flat in vec4 c01, c23, c45, c67;  // two corners each
flat in float half_stroke;
flat in vec4 fill;
flat in vec4 stroke;
flat in vec4 slopes;
flat in vec4 offsets;
layout(location = 0) out vec4 color;

float least_square;  // of the distances to the edges seen so far
float least_side;    // positive while p is inside of all edges seen so far

void see_edge(vec2 p, vec2 from, vec2 to) {
  vec2 edge = to - from;
  vec2 offset = p - from;
  float t = clamp(dot(offset, edge) / max(dot(edge, edge), 1e-12), 0.0, 1.0);
  vec2 to_edge = offset - t * edge;
  least_square = min(least_square, dot(to_edge, to_edge));
  least_side = min(least_side, edge.x * offset.y - edge.y * offset.x);
}

void main() {
  vec2 p = gl_FragCoord.xy;
  least_square = 1e30;
  least_side = 1e30;
  see_edge(p, c01.xy, c01.zw);
  see_edge(p, c01.zw, c23.xy);
  see_edge(p, c23.xy, c23.zw);
  see_edge(p, c23.zw, c45.xy);
  see_edge(p, c45.xy, c45.zw);
  see_edge(p, c45.zw, c67.xy);
  see_edge(p, c67.xy, c67.zw);
  see_edge(p, c67.zw, c01.xy);
  float d = sqrt(least_square) * (least_side > 0.0 ? -1.0 : 1.0);
  color = paint(d, half_stroke, fill, stroke) * fade(slopes, offsets);
}
