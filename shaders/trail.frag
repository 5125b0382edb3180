flat in vec4 piece;  // the two ends
flat in vec4 size;   // half width at the two ends, opacity at the two ends
layout(location = 0) out float value;

void main() {
  vec2 along = piece.zw - piece.xy;
  vec2 offset = gl_FragCoord.xy - piece.xy;
  float t = clamp(dot(offset, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  vec2 to_line = offset - t * along;
  float d = sqrt(dot(to_line, to_line)) - mix(size.x, size.y, t);
  value = coverage(d) * mix(size.z, size.w, t);
}
