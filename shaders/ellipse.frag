// Signed distance to an ellipse with semi-axes a >= b, exact for every eccentricity. The foot of the
// perpendicular from (x, y) >= 0 is (a u, b v) with
//   u = r (x/a) / (w + r - 1),  v = (y/b) / w,  r = (a/b)^2,  u^2 + v^2 = 1
// (D. Eberly, "Distance from a point to an ellipse", 2013, with his s + 1 = w, which does not cancel near
// the major axis). 1/sqrt(u^2 + v^2) is a concave, almost straight function of w, so Newton's method on it
// climbs to the root from any start below: two or three passes for common shapes, up to 16 at the tips of
// a needle.
flat in vec4 frame;  // centre, unit direction of the major axis
flat in vec3 size;   // major and minor semi-axis, half stroke
flat in vec4 fill;
flat in vec4 stroke;
flat in vec4 slopes;
flat in vec4 offsets;
layout(location = 0) out vec4 color;

const int kMostPasses = 16;
const float kSmallest = 1e-6;  // keeps v defined on the major axis

float distance_to_edge(vec2 p, vec2 ab, float reach) {
  vec2 z = vec2(p.x / ab.x, max(p.y / ab.y, kSmallest));
  float level = sqrt(dot(z, z));
  // The ellipse scaled by `level` passes through p; the two are at least this far apart.
  float least = (level - 1.0) * ab.y;
  bool is_far = abs(least) > reach;
  // Not an early return: a loop that nobody enters costs nothing, one behind a mask costs all its passes.
  int passes = is_far ? 0 : kMostPasses;

  float ratio = ab.x / ab.y;
  float r_less_1 = (ratio - 1.0) * (ratio + 1.0);
  float numerator = ratio * ratio * z.x;
  float w = max(z.y, numerator - r_less_1);
  vec2 foot = vec2(0.0);
  for (int pass = 0; pass <= passes; ++pass) {
    vec2 over = vec2(w + r_less_1, w);
    foot = vec2(numerator, z.y) / over;
    float square = dot(foot, foot);
    float norm = sqrt(square);
    if (norm < 1.00002) break;
    w += square * (norm - 1.0) / dot(foot * foot, 1.0 / over);
  }
  foot /= sqrt(dot(foot, foot));
  vec2 to_foot = foot * ab - p;
  return is_far ? least : sign(least) * sqrt(dot(to_foot, to_foot));
}

void main() {
  vec2 from_center = gl_FragCoord.xy - frame.xy;
  vec2 p = vec2(dot(from_center, frame.zw), from_center.y * frame.z - from_center.x * frame.w);
  color = paint(distance_to_edge(abs(p), size.xy, size.z + 1.0), size.z, fill, stroke) * fade(slopes, offsets);
}
