#version 330 core
// Put before every fragment shader. Colours are premultiplied by their opacity; distances are in pixels,
// negative inside.

// Share of the pixel that lies inside a straight edge at signed distance d.
float coverage(float d) { return clamp(0.5 - d, 0.0, 1.0); }

// How much is left of a shape here that fades linearly towards left, right, upper and lower edges; see Fading in
// render/batch.cpp.
float fade(vec4 slopes, vec4 offsets) {
  vec2 p = gl_FragCoord.xy;
  vec4 levels = slopes * vec4(p.x, -p.x, p.y, -p.y) + offsets;
  return clamp(min(min(levels.x, levels.y), min(levels.z, levels.w)), 0.0, 1.0);
}

// A fill up to the edge and a stroke centred on it. The pixel is divided into what only the fill covers,
// what both cover and what only the stroke covers, so that no background shines through between the two.
vec4 paint(float d, float half_stroke, vec4 fill, vec4 stroke) {
  float inner = coverage(d + half_stroke);
  float middle = coverage(d);
  float outer = coverage(d - half_stroke);
  vec4 both = stroke + fill * (1.0 - stroke.a);
  return fill * inner + both * (middle - inner) + stroke * (outer - middle);
}
