// The fragment shaders of shaders/, for four pixels of a row at once: the same operations in the same order,
// so that pixels have the bytes that OpenGL's software renderer gives them.
#pragma once

#include <algorithm>
#include <array>

#include "render/lanes.hpp"

namespace chainreel::shades {

struct Color4 {
  Float4 r, g, b, a;
};

inline Float4 between(Float4 x, float low, float high) {
  return least(most(x, all4(low)), all4(high));
}
inline Float4 coverage(Float4 d) {
  return between(0.5F - d, 0.0F, 1.0F);
}
inline Float4 mixed(float from, float to, Float4 t) {
  return from + t * (to - from);
}
inline Float4 chosen(Int4 which, Float4 yes, Float4 no) {
  return which ? yes : no;
}

constexpr Float4 kNoLevel = {0, 0, 0, 0};
constexpr Color4 kNoColor = {kNoLevel, kNoLevel, kNoLevel, kNoLevel};

inline Color4 operator*(const Color4& color, Float4 by) {
  return {color.r * by, color.g * by, color.b * by, color.a * by};
}

// Its pixels as bytes: blue lowest, opacity highest.
inline Int4 bytes_of(const Color4& color) {
  const auto level = [](Float4 c) { return rounded_to_even(255.0F * between(c, 0.0F, 1.0F)); };
  return level(color.b) | level(color.g) << 8 | level(color.r) << 16 | level(color.a) << 24;
}

template <std::size_t kCount>
std::array<float, kCount> numbers_of(const float* from) {
  std::array<float, kCount> numbers;
  std::copy(from, from + kCount, numbers.begin());
  return numbers;
}

struct Fill {
  explicit Fill(const float* n) : color{all4(n[0]), all4(n[1]), all4(n[2]), all4(n[3])} {}
  Color4 color;
};

// paint() of paint.glsl.
class Paint {
 public:
  Paint(float half_stroke, const float* fill, const float* stroke)
      : half_stroke_(half_stroke), fill_(fill), stroke_(stroke), both_(fill) {
    const Color4 through = fill_.color * (1.0F - stroke_.color.a);
    both_.color = {stroke_.color.r + through.r, stroke_.color.g + through.g, stroke_.color.b + through.b,
                   stroke_.color.a + through.a};
  }
  // Whether all four lie where there is neither fill nor stroke.
  bool is_beyond(Float4 d) const { return bits_of(d - half_stroke_ >= 0.5F) == 15; }
  bool fills() const { return fill_.color.a[0] > 0; }
  const Color4& fill() const { return fill_.color; }
  Color4 at(Float4 d) const {
    const Float4 middle = coverage(d);
    if (half_stroke_ == 0) return fill_.color * middle;
    const Float4 inside = d + half_stroke_;
    if (bits_of(inside <= -0.5F) == 15) return fill_.color;
    const Float4 inner = coverage(inside), outer = coverage(d - half_stroke_);
    const Float4 of_both = middle - inner, of_stroke = outer - middle;
    const auto sum = [&](Float4 fill, Float4 both, Float4 stroke) {
      return fill * inner + both * of_both + stroke * of_stroke;
    };
    const Color4 &f = fill_.color, &b = both_.color, &s = stroke_.color;
    return {sum(f.r, b.r, s.r), sum(f.g, b.g, s.g), sum(f.b, b.b, s.b), sum(f.a, b.a, s.a)};
  }

 private:
  float half_stroke_;
  Fill fill_, stroke_, both_;
};

// fade() of paint.glsl.
struct Fade {
  std::array<float, 8> n;  // slopes, offsets

  explicit Fade(const float* numbers) : n(numbers_of<8>(numbers)) {}
  Float4 at(Float4 x, float y) const {
    const Float4 across = least(n[0] * x + n[4], n[1] * -x + n[5]);
    const float along = std::min(n[2] * y + n[6], n[3] * -y + n[7]);
    return between(least(across, all4(along)), 0.0F, 1.0F);
  }
};

struct Capsule {
  std::array<float, 20> n;
  float length = std::max(n[4], 1e-6F);
  bool is_even = n[8] == 1 && n[9] == 1;
  Paint paint{n[6], &n[12], &n[16]};

  explicit Capsule(const float* numbers) : n(numbers_of<20>(numbers)) {}
  Color4 operator()(Float4 px, float py) const {
    const Float4 x = px - n[0];
    const float y = py - n[1];
    const Float4 along = x * n[2] + y * n[3], across = y * n[2] - x * n[3];
    const Float4 beside = along - between(along, 0.0F, n[4]);
    const Float4 d = root(beside * beside + across * across) - n[5];
    if (paint.is_beyond(d)) return kNoColor;
    if (is_even) return paint.at(d);
    const Float4 t = between(along / length, 0.0F, 1.0F);
    return paint.at(d) * mixed(n[8], n[9], t);
  }
};

struct Arc {
  std::array<float, 12> n;
  Fill fill{&n[8]};

  explicit Arc(const float* numbers) : n(numbers_of<12>(numbers)) {}
  Color4 operator()(Float4 px, float py) const {
    const Float4 x = px - n[0];
    const float y = py - n[1];
    const Float4 u = x * n[2] + y * n[3], v = magnitude(y * n[2] - x * n[3]);
    const float end_u = n[7], end_v = n[6];
    const Int4 beside_arc = v * end_u <= u * end_v;
    const Float4 to_u = u - n[4] * end_u, to_v = v - n[4] * end_v;
    const Float4 to_line =
        chosen(beside_arc, magnitude(root(u * u + v * v) - n[4]), root(to_u * to_u + to_v * to_v));
    return fill.color * coverage(to_line - n[5]);
  }
};

struct Ellipse {
  static constexpr int kMostPasses = 16;

  std::array<float, 24> n;
  float a = n[4], b = n[5];
  float ratio = a / b;
  float r_less_1 = (ratio - 1.0F) * (ratio + 1.0F);
  float reach = n[6] + 1.0F;
  // The square of the level beyond which, and below which, pixels surely are farther from the edge than that.
  float per_a = 1 / a, per_b = 1 / b;
  float off = (reach + 0.01F) / b;
  float outside = 1.0001F * (1 + off) * (1 + off), inside = off < 1 ? 0.9999F * (1 - off) * (1 - off) : -1;
  float farthest = n[6] + 0.52F + 1e-6F * a;  // px from the edge at which there is colour
  Paint paint{n[6], &n[12], &n[8]};
  Fade fade{&n[16]};

  explicit Ellipse(const float* numbers) : n(numbers_of<24>(numbers)) {}
  Color4 operator()(Float4 px, float py) const {
    const Float4 x = px - n[0];
    const float y = py - n[1];
    const Float4 u = x * n[2] + y * n[3], v = y * n[2] - x * n[3];
    const Float4 scaled_u = u * per_a, scaled_v = v * per_b,
                 square = scaled_u * scaled_u + scaled_v * scaled_v;
    if (bits_of(square > outside) == 15) return kNoColor;
    if (bits_of(square < inside) == 15) return paint.fills() ? paint.fill() * fade.at(px, py) : kNoColor;
    if (bits_of(is_beyond_tangent(scaled_u, scaled_v, square)) == 15) return kNoColor;
    const Float4 d = distance(magnitude(u), magnitude(v));
    if (paint.is_beyond(d)) return kNoColor;
    return paint.at(d) * fade.at(px, py);
  }
  // The ellipse lies on one side of its tangent where the ray to the pixel leaves it; so the edge is at least
  // as far away.
  Int4 is_beyond_tangent(Float4 scaled_u, Float4 scaled_v, Float4 square) const {
    const Float4 normal_u = scaled_u * per_a, normal_v = scaled_v * per_b, level = root(square);
    return (level - 1.0F) * level > farthest * root(normal_u * normal_u + normal_v * normal_v);
  }
  Float4 distance(Float4 u, Float4 v) const {
    const Float4 zu = u / a, zv = most(v / b, all4(1e-6F));
    const Float4 level = root(zu * zu + zv * zv);
    const Float4 at_least = (level - 1.0F) * b;
    const Int4 is_far = magnitude(at_least) > reach;
    if (bits_of(is_far) == 15) return at_least;
    const Float4 numerator = ratio * ratio * zu;
    Float4 w = most(zv, numerator - r_less_1), foot_u = all4(0.0F), foot_v = all4(0.0F);
    Int4 seeks = ~is_far;
    for (int pass = 0; pass <= kMostPasses; ++pass) {
      const Float4 over_u = w + r_less_1;
      const Float4 u_now = numerator / over_u, v_now = zv / w;
      foot_u = chosen(seeks, u_now, foot_u);
      foot_v = chosen(seeks, v_now, foot_v);
      const Float4 square = u_now * u_now + v_now * v_now, norm = root(square);
      seeks &= ~(norm < 1.00002F);
      if (bits_of(seeks) == 0) break;
      const Float4 step =
          square * (norm - 1.0F) / (u_now * u_now * (1.0F / over_u) + v_now * v_now * (1.0F / w));
      w = chosen(seeks, w + step, w);
    }
    const Float4 norm = root(foot_u * foot_u + foot_v * foot_v);
    const Float4 to_u = foot_u / norm * a - u, to_v = foot_v / norm * b - v;
    const Float4 distance = root(to_u * to_u + to_v * to_v);
    const Float4 zero = all4(0.0F);
    const Float4 sided = chosen(at_least > 0.0F, distance, chosen(at_least < 0.0F, -distance, zero));
    return chosen(is_far, at_least, sided);
  }
};

struct Polygon {
  static constexpr int kCorners = 8;

  std::array<float, 36> n;
  float square[kCorners];
  Paint paint{n[16], &n[24], &n[20]};
  Fade fade{&n[28]};

  explicit Polygon(const float* numbers) : n(numbers_of<36>(numbers)) {
    for (int i = 0; i < kCorners; ++i) {
      const float *from = &n[std::size_t(2 * i)], *to = &n[std::size_t(2 * ((i + 1) % kCorners))];
      const float x = to[0] - from[0], y = to[1] - from[1];
      square[i] = std::max(x * x + y * y, 1e-12F);
    }
  }
  Color4 operator()(Float4 px, float py) const {
    Float4 least_square = all4(1e30F), least_side = all4(1e30F);
    for (int i = 0; i < kCorners; ++i) {
      const float *from = &n[std::size_t(2 * i)], *to = &n[std::size_t(2 * ((i + 1) % kCorners))];
      const float edge_x = to[0] - from[0], edge_y = to[1] - from[1];
      const Float4 x = px - from[0];
      const float y = py - from[1];
      const Float4 t = between((x * edge_x + y * edge_y) / square[i], 0.0F, 1.0F);
      const Float4 to_x = x - t * edge_x, to_y = y - t * edge_y;
      least_square = least(least_square, to_x * to_x + to_y * to_y);
      least_side = least(least_side, edge_x * y - edge_y * x);
    }
    const Float4 far = root(least_square);
    const Float4 d = chosen(least_side > 0.0F, -far, far);
    if (paint.is_beyond(d)) return kNoColor;
    return paint.at(d) * fade.at(px, py);
  }
};

struct Faded {
  Fill fill;
  Fade fade;

  explicit Faded(const float* n) : fill(n), fade(n + 4) {}
  Color4 operator()(Float4 px, float py) const { return fill.color * fade.at(px, py); }
};

// A level, not a colour.
struct Trail {
  std::array<float, 8> n;
  float along_x = n[2] - n[0], along_y = n[3] - n[1];
  float square = std::max(along_x * along_x + along_y * along_y, 1e-12F);

  explicit Trail(const float* numbers) : n(numbers_of<8>(numbers)) {}
  Float4 operator()(Float4 px, float py) const {
    const Float4 x = px - n[0];
    const float y = py - n[1];
    const Float4 t = between((x * along_x + y * along_y) / square, 0.0F, 1.0F);
    const Float4 to_x = x - t * along_x, to_y = y - t * along_y;
    const Float4 d = root(to_x * to_x + to_y * to_y) - mixed(n[4], n[5], t);
    return coverage(d) * mixed(n[6], n[7], t);
  }
};

}  // namespace chainreel::shades
