#version 330 core
// Put before every vertex shader. Page pixels: origin at the upper left, y down. Row 0 of the framebuffer
// is the page's top row, so pixels need no flipping when they are read, and gl_FragCoord.xy is a page
// position.
uniform vec2 page_px;

vec4 clip_position(vec2 px) { return vec4(2.0 * px / page_px - 1.0, 0.0, 1.0); }

// The corners of a quad as a strip: -1 or 1 in each direction.
vec2 quad_corner() { return vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0; }

// An edge's ramp reaches half a pixel outward; the rest is for the rounding of the quad's corners.
const float kFringe = 1.0;
