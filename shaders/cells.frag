uniform sampler2D sheet;  // one texel a cell

flat in vec4 rect;   // left, top, right, bottom
flat in vec2 cells;  // across and down
layout(location = 0) out vec4 color;

void main() {
  vec2 p = gl_FragCoord.xy;
  vec2 cell = clamp(floor(cells * (p - rect.xy) / (rect.zw - rect.xy)), vec2(0.0), cells - 1.0);
  vec2 low = p - rect.xy, high = rect.zw - p;
  float inside = coverage(-min(low.x, high.x)) * coverage(-min(low.y, high.y));
  color = inside * texelFetch(sheet, ivec2(cell), 0);
}
