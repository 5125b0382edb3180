// Part of a circle's edge with round ends, symmetric about the direction to its middle.
flat in vec4 frame;  // centre, unit direction to the middle of the arc
flat in vec4 shape;  // radius, half width, sine and cosine of half the sweep
flat in vec4 fill;
layout(location = 0) out vec4 color;

void main() {
  vec2 from_center = gl_FragCoord.xy - frame.xy;
  vec2 p = vec2(dot(from_center, frame.zw), abs(from_center.y * frame.z - from_center.x * frame.w));
  vec2 end = shape.wz;
  bool beside_arc = p.y * end.x <= p.x * end.y;  // the angle of p is at most that of the end
  vec2 to_end = p - shape.x * end;
  float to_line = beside_arc ? abs(sqrt(dot(p, p)) - shape.x) : sqrt(dot(to_end, to_end));
  color = fill * coverage(to_line - shape.y);
}
