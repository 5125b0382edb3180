// The fragment shaders of shaders/, for several pixels of a row at once: the same operations in the same
// order, so that pixels have the bytes that OpenGL's software renderer gives them, and windows filled with
// them. Included for each width of the processor's vectors, within a namespace that says what Floats, Ints,
// kLanes and kCenters are; so it includes nothing and has no guard.

struct Colors {
  Floats r, g, b, a;
};

inline Floats all(float x) {
  return Floats{} + x;
}
inline Floats least(Floats a, Floats b) {
  return a < b ? a : b;
}
inline Floats most(Floats a, Floats b) {
  return a > b ? a : b;
}
inline Floats magnitude(Floats x) {
  return Floats(Ints(x) & 0x7fffffff);
}
inline Floats between(Floats x, float low, float high) {
  return least(most(x, all(low)), all(high));
}
inline Floats coverage(Floats d) {
  return between(0.5F - d, 0.0F, 1.0F);
}
inline Floats mixed(float from, float to, Floats t) {
  return from + t * (to - from);
}
inline Floats chosen(Ints which, Floats yes, Floats no) {
  return which ? yes : no;
}

constexpr Colors kNoColor = {};

inline Colors operator*(const Colors& color, Floats by) {
  return {color.r * by, color.g * by, color.b * by, color.a * by};
}

inline Ints level(Floats c) {
  return rounded_to_even(255.0F * between(c, 0.0F, 1.0F));
}
// Its pixels as bytes: blue lowest, opacity highest.
inline Ints bytes_of(const Colors& color) {
  return level(color.b) | level(color.g) << 8 | level(color.r) << 16 | level(color.a) << 24;
}

template <std::size_t kCount>
std::array<float, kCount> numbers_of(const float* from) {
  std::array<float, kCount> numbers;
  std::copy(from, from + kCount, numbers.begin());
  return numbers;
}

struct Fill {
  explicit Fill(const float* n) : color{all(n[0]), all(n[1]), all(n[2]), all(n[3])} {}
  Colors color;
};

// paint() of paint.glsl.
class Paint {
 public:
  Paint(float half_stroke, const float* fill, const float* stroke)
      : half_stroke_(half_stroke), fill_(fill), stroke_(stroke), both_(fill) {
    const Colors through = fill_.color * (1.0F - stroke_.color.a);
    both_.color = {stroke_.color.r + through.r, stroke_.color.g + through.g, stroke_.color.b + through.b,
                   stroke_.color.a + through.a};
  }
  // Whether all four lie where there is neither fill nor stroke.
  bool is_beyond(Floats d) const { return are_all(d - half_stroke_ >= 0.5F); }
  bool fills() const { return fill_.color.a[0] > 0; }
  const Colors& fill() const { return fill_.color; }
  Colors at(Floats d) const {
    const Floats middle = coverage(d);
    if (half_stroke_ == 0) return fill_.color * middle;
    const Floats inside = d + half_stroke_;
    if (are_all(inside <= -0.5F)) return fill_.color;
    const Floats inner = coverage(inside), outer = coverage(d - half_stroke_);
    const Floats of_both = middle - inner, of_stroke = outer - middle;
    const Colors &f = fill_.color, &b = both_.color, &s = stroke_.color;
    return {f.r * inner + b.r * of_both + s.r * of_stroke, f.g * inner + b.g * of_both + s.g * of_stroke,
            f.b * inner + b.b * of_both + s.b * of_stroke, f.a * inner + b.a * of_both + s.a * of_stroke};
  }

 private:
  float half_stroke_;
  Fill fill_, stroke_, both_;
};

// fade() of paint.glsl.
struct Fade {
  std::array<float, 8> n;  // slopes, offsets

  explicit Fade(const float* numbers) : n(numbers_of<8>(numbers)) {}
  Floats at(Floats x, float y) const {
    const Floats across = least(n[0] * x + n[4], n[1] * -x + n[5]);
    const float along = std::min(n[2] * y + n[6], n[3] * -y + n[7]);
    return between(least(across, all(along)), 0.0F, 1.0F);
  }
};

struct Capsule {
  std::array<float, 20> n;
  float length = std::max(n[4], 1e-6F);
  bool is_even = n[8] == 1 && n[9] == 1;
  Paint paint{n[6], &n[12], &n[16]};

  explicit Capsule(const float* numbers) : n(numbers_of<20>(numbers)) {}
  Colors operator()(Floats px, float py) const {
    const Floats x = px - n[0];
    const float y = py - n[1];
    const Floats along = x * n[2] + y * n[3], across = y * n[2] - x * n[3];
    const Floats beside = along - between(along, 0.0F, n[4]);
    const Floats d = root(beside * beside + across * across) - n[5];
    if (paint.is_beyond(d)) return kNoColor;
    if (is_even) return paint.at(d);
    const Floats t = between(along / length, 0.0F, 1.0F);
    return paint.at(d) * mixed(n[8], n[9], t);
  }
};

struct Arc {
  std::array<float, 12> n;
  Fill fill{&n[8]};

  explicit Arc(const float* numbers) : n(numbers_of<12>(numbers)) {}
  Colors operator()(Floats px, float py) const {
    const Floats x = px - n[0];
    const float y = py - n[1];
    const Floats u = x * n[2] + y * n[3], v = magnitude(y * n[2] - x * n[3]);
    const float end_u = n[7], end_v = n[6];
    const Ints beside_arc = v * end_u <= u * end_v;
    const Floats to_u = u - n[4] * end_u, to_v = v - n[4] * end_v;
    const Floats to_line =
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
  Colors operator()(Floats px, float py) const {
    const Floats x = px - n[0];
    const float y = py - n[1];
    const Floats u = x * n[2] + y * n[3], v = y * n[2] - x * n[3];
    const Floats scaled_u = u * per_a, scaled_v = v * per_b,
                 square = scaled_u * scaled_u + scaled_v * scaled_v;
    if (are_all(square > outside)) return kNoColor;
    if (are_all(square < inside)) return paint.fills() ? paint.fill() * fade.at(px, py) : kNoColor;
    if (are_all(is_beyond_tangent(scaled_u, scaled_v, square))) return kNoColor;
    const Floats d = distance(magnitude(u), magnitude(v));
    if (paint.is_beyond(d)) return kNoColor;
    return paint.at(d) * fade.at(px, py);
  }
  // The ellipse lies on one side of its tangent where the ray to the pixel leaves it; so the edge is at least
  // as far away.
  Ints is_beyond_tangent(Floats scaled_u, Floats scaled_v, Floats square) const {
    const Floats normal_u = scaled_u * per_a, normal_v = scaled_v * per_b, level = root(square);
    return (level - 1.0F) * level > farthest * root(normal_u * normal_u + normal_v * normal_v);
  }
  Floats distance(Floats u, Floats v) const {
    const Floats zu = u / a, zv = most(v / b, all(1e-6F));
    const Floats level = root(zu * zu + zv * zv);
    const Floats at_least = (level - 1.0F) * b;
    const Ints is_far = magnitude(at_least) > reach;
    if (are_all(is_far)) return at_least;
    const Floats numerator = ratio * ratio * zu;
    Floats w = most(zv, numerator - r_less_1), foot_u = all(0.0F), foot_v = all(0.0F);
    Ints seeks = ~is_far;
    for (int pass = 0; pass <= kMostPasses; ++pass) {
      const Floats over_u = w + r_less_1;
      const Floats u_now = numerator / over_u, v_now = zv / w;
      foot_u = chosen(seeks, u_now, foot_u);
      foot_v = chosen(seeks, v_now, foot_v);
      const Floats square = u_now * u_now + v_now * v_now, norm = root(square);
      seeks &= ~(norm < 1.00002F);
      if (are_all(~seeks)) break;
      const Floats step =
          square * (norm - 1.0F) / (u_now * u_now * (1.0F / over_u) + v_now * v_now * (1.0F / w));
      w = chosen(seeks, w + step, w);
    }
    const Floats norm = root(foot_u * foot_u + foot_v * foot_v);
    const Floats to_u = foot_u / norm * a - u, to_v = foot_v / norm * b - v;
    const Floats distance = root(to_u * to_u + to_v * to_v);
    const Floats zero = all(0.0F);
    const Floats sided = chosen(at_least > 0.0F, distance, chosen(at_least < 0.0F, -distance, zero));
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
  Colors operator()(Floats px, float py) const {
    Floats least_square = all(1e30F), least_side = all(1e30F);
    for (int i = 0; i < kCorners; ++i) {
      const float *from = &n[std::size_t(2 * i)], *to = &n[std::size_t(2 * ((i + 1) % kCorners))];
      const float edge_x = to[0] - from[0], edge_y = to[1] - from[1];
      const Floats x = px - from[0];
      const float y = py - from[1];
      const Floats t = between((x * edge_x + y * edge_y) / square[i], 0.0F, 1.0F);
      const Floats to_x = x - t * edge_x, to_y = y - t * edge_y;
      least_square = least(least_square, to_x * to_x + to_y * to_y);
      least_side = least(least_side, edge_x * y - edge_y * x);
    }
    const Floats far = root(least_square);
    const Floats d = chosen(least_side > 0.0F, -far, far);
    if (paint.is_beyond(d)) return kNoColor;
    return paint.at(d) * fade.at(px, py);
  }
};

struct Faded {
  Fill fill;
  Fade fade;

  explicit Faded(const float* n) : fill(n), fade(n + 4) {}
  Colors operator()(Floats px, float py) const { return fill.color * fade.at(px, py); }
};

// A level, not a colour.
struct Trail {
  std::array<float, 8> n;
  float along_x = n[2] - n[0], along_y = n[3] - n[1];
  float square = std::max(along_x * along_x + along_y * along_y, 1e-12F);

  explicit Trail(const float* numbers) : n(numbers_of<8>(numbers)) {}
  Floats operator()(Floats px, float py) const {
    const Floats x = px - n[0];
    const float y = py - n[1];
    const Floats t = between((x * along_x + y * along_y) / square, 0.0F, 1.0F);
    const Floats to_x = x - t * along_x, to_y = y - t * along_y;
    const Floats d = root(to_x * to_x + to_y * to_y) - mixed(n[4], n[5], t);
    return coverage(d) * mixed(n[6], n[7], t);
  }
};

static_assert(sizeof(Floats) == kLanes * sizeof(float));

// Pixels at the left of those that are drawn together, of which the first `count` are on the page.
inline void put(Ints above, std::uint32_t* pixels, int count) {
  if (are_all(above == 0)) return;
  Ints below = {};
  const std::size_t bytes = std::size_t(std::min(count, kLanes)) * sizeof(std::uint32_t);
  if (bytes == sizeof below) {
    std::memcpy(&below, pixels, sizeof below);
    below = put_over(above, below);
    std::memcpy(pixels, &below, sizeof below);
  } else {
    std::memcpy(&below, pixels, bytes);
    below = put_over(above, below);
    std::memcpy(pixels, &below, bytes);
  }
}

template <class Shade>
void fill_with(const PixelBox& box, const float* numbers, std::uint32_t* page, std::ptrdiff_t stride) {
  const Shade shade(numbers);
  for (int y = box.y; y < box.bottom(); ++y) {
    std::uint32_t* row = page + y * stride;
    for (int x = box.x; x < box.right(); x += kLanes)
      put(bytes_of(shade(float(x) + kCenters, float(y) + 0.5F)), row + x, box.right() - x);
  }
}

inline void fill_window(Primitive primitive, const PixelBox& box, const float* numbers, std::uint32_t* page,
                        std::ptrdiff_t stride) {
  switch (primitive) {
    case Primitive::capsule:
      return fill_with<Capsule>(box, numbers, page, stride);
    case Primitive::ellipse:
      return fill_with<Ellipse>(box, numbers, page, stride);
    case Primitive::arc:
      return fill_with<Arc>(box, numbers, page, stride);
    case Primitive::polygon:
      return fill_with<Polygon>(box, numbers, page, stride);
    case Primitive::faded:
      return fill_with<Faded>(box, numbers, page, stride);
    default:  // of no formula
      return;
  }
}

// The largest value stays.
inline void fill_trail_window(const PixelBox& box, const float* numbers, std::uint8_t* trail,
                              std::ptrdiff_t stride) {
  const Trail shade(numbers);
  for (int y = box.y; y < box.bottom(); ++y) {
    std::uint8_t* row = trail + y * stride;
    for (int x = box.x; x < box.right(); x += kLanes) {
      const Ints levels =
          rounded_to_even(255.0F * between(shade(float(x) + kCenters, float(y) + 0.5F), 0.0F, 1.0F));
      if (are_all(levels == 0)) continue;
      for (int k = 0, count = std::min(kLanes, box.right() - x); k < count; ++k)
        row[x + k] = std::max(row[x + k], std::uint8_t(levels[k]));
    }
  }
}
