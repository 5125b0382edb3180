uniform sampler2D layer;  // several samples a pixel, the whole page
uniform vec2 page_px;

flat in vec4 how;
flat in vec4 line;
layout(location = 0) out vec4 color;

// Round enough for a line of a few pixels.
const vec2 kAround[12] = vec2[12](vec2(1.0, 0.0), vec2(0.866, 0.5), vec2(0.5, 0.866), vec2(0.0, 1.0), vec2(-0.5, 0.866),
                                  vec2(-0.866, 0.5), vec2(-1.0, 0.0), vec2(-0.866, -0.5), vec2(-0.5, -0.866),
                                  vec2(0.0, -1.0), vec2(0.5, -0.866), vec2(0.866, -0.5));

// Whether a body is there, however much shines through it: 0 beyond the layer.
float body(ivec2 texel) {
  ivec2 size = textureSize(layer, 0);
  if (texel.x < 0 || texel.y < 0 || texel.x >= size.x || texel.y >= size.y) return 0.0;
  return texelFetch(layer, texel, 0).a > 0.0 ? 1.0 : 0.0;
}

// Rings two samples apart, so that a thin body does not slip between them.
float body_near(ivec2 texel, float radius) {
  float seen = 0.0;
  for (float r = radius; r > 0.5; r -= 2.0)
    for (int i = 0; i < 12; ++i) seen = max(seen, body(texel + ivec2(floor(r * kAround[i] + 0.5))));
  return seen;
}

void main() {
  int samples = textureSize(layer, 0).x / int(page_px.x + 0.5);
  ivec2 first = samples * ivec2(gl_FragCoord.xy);
  float share = 1.0 / float(samples * samples);
  vec4 inside = vec4(0.0);
  float covered = 0.0;
  for (int y = 0; y < samples; ++y)
    for (int x = 0; x < samples; ++x) {
      vec4 one = texelFetch(layer, first + ivec2(x, y), 0);
      inside += share * one;
      covered += one.a > 0.0 ? share : 0.0;
    }
  vec4 around = vec4(0.0);
  float radius = how.y * float(samples);
  // Most pixels without a body are far from one: the rings about the middle, a pixel wider, find that out at once.
  if (how.y > 0.0 && covered < 0.999 &&
      (covered > 0.0 || body_near(first + samples / 2, radius + float(samples)) > 0.0)) {
    float reach = 0.0;
    for (int y = 0; y < samples; ++y)
      for (int x = 0; x < samples; ++x) {
        ivec2 texel = first + ivec2(x, y);
        reach += share * (body(texel) > 0.0 ? 0.0 : body_near(texel, radius));
      }
    around = reach * line;
  }
  color = how.x * (inside + around);
}
