flat in vec4 corners[4];  // two each
flat in float half_stroke;
flat in vec4 fill;
flat in vec4 stroke;
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
  for (int i = 0; i < 4; ++i) {
    see_edge(p, corners[i].xy, corners[i].zw);
    see_edge(p, corners[i].zw, corners[(i + 1) % 4].xy);
  }
  float d = sqrt(least_square) * (least_side > 0.0 ? -1.0 : 1.0);
  color = paint(d, half_stroke, fill, stroke);
}
