#version 330 core
// Put before every vertex shader. Page pixels: origin at the upper left, y down. Row 0 of the framebuffer
// is the page's top row, so pixels need no flipping when they are read, and gl_FragCoord.xy is a page
// position.
uniform vec2 page_px;

vec4 clip_position(vec2 px) { return vec4(2.0 * px / page_px - 1.0, 0.0, 1.0); }

// The corner of the rectangle (left, top, right, bottom) that a vertex is, four to each. Shapes fill windows of
// whole pixels, so that any part of the page can be drawn alone.
vec4 corner_of(vec4 window) {
  return clip_position(mix(window.xy, window.zw, vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1 & 1))));
}
