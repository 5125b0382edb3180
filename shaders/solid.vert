// A vertex of a body, lit where it stands, so that no fragment has to bring a normal back to length one.
layout(location = 0) in vec3 position;  // m, in the mesh's coordinates
layout(location = 1) in vec3 normal;    // unit
layout(location = 2) in vec4 paint;     // straight

uniform vec4 row_x, row_y, row_z;  // to view coordinates
uniform vec4 page;                 // origin of the view, px; scale, px/m; nearness, 1/m
uniform vec4 own_color;            // a < 0: that of the vertices
uniform vec4 depth;                // depth of clip space = x z + y; z: 1 lights, 0 leaves the colour flat
out vec4 color;                    // premultiplied

// One key light from the upper left in front, one weak fill from the right. Surfaces that turn away from the
// viewer darken, so that a white body has an edge on a white page.
float light(vec3 n) {
  const vec3 key = vec3(-0.485, 0.647, 0.588), fill = vec3(0.700, -0.140, 0.700);
  float diffuse = 0.52 * max(dot(n, key), 0.0) + 0.18 * max(dot(n, fill), 0.0);
  float facing = 0.62 + 0.38 * max(n.z, 0.0);
  return min(1.0, (0.43 + diffuse) * facing + 0.08);
}

void main() {
  vec4 p = vec4(position, 1.0);
  vec3 v = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  vec3 n = vec3(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal));
  float w = 1.0 - v.z * page.w;
  gl_Position = vec4(2.0 * (page.xy * w + page.z * vec2(v.x, -v.y)) / page_px - w, depth.x * v.z + depth.y, w);
  vec4 base = own_color.a < 0.0 ? paint : own_color;
  float level = depth.z > 0.5 ? light(n) : 1.0;
  color = vec4(base.rgb * level * base.a, base.a);
}
