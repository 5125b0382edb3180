flat in vec4 axis;   // one end, unit direction to the other
flat in vec3 size;   // length, radius, half stroke
flat in vec2 alpha;  // opacity at the two ends
flat in vec4 fill;
flat in vec4 stroke;
layout(location = 0) out vec4 color;

void main() {
  vec2 from_end = gl_FragCoord.xy - axis.xy;
  float along = dot(from_end, axis.zw);
  float across = from_end.y * axis.z - from_end.x * axis.w;
  float beside = along - clamp(along, 0.0, size.x);
  float d = sqrt(beside * beside + across * across) - size.y;
  float t = clamp(along / max(size.x, 1e-6), 0.0, 1.0);
  color = paint(d, size.z, fill, stroke) * mix(alpha.x, alpha.y, t);
}
