// Single masses: with w_i = 1 / m_i (w_0 = 0) the conditions on lambda are tridiagonal,
//
//   w_{i-1} e_i.d_{i-1} lambda_{i-1} - (w_{i-1} + w_i) e_i.d_i lambda_i + w_i e_i.d_{i+1} lambda_{i+1} =
//   change_i,
//
// and eliminated from the base. Coupled masses: from the tip, each point with its link's impulse is expressed
// by the point before, as the articulated-body algorithm does. For point i, with (P, t, l, s) of point i + 1,
//
//   W move_i + o_{i-1} move_{i-1} + d_i lambda_i = r,   W = m_i 1 + o_i P - d_{i+1} l^T,   r = d_{i+1} s -
//   o_i t,
//
// and the condition on the link gives lambda_i. Neither exchanges rows: with e = d the conditions are those
// of a positive definite matrix, and in a step e is near d.
#include "integrate/linked_masses.hpp"

namespace chainreel {

LinkedMasses::LinkedMasses(std::span<const LinkedPoints::Link> links)
    : diagonal_(links.size()),
      off_(links.size()),
      inverse_(links.size()),
      factor_(links.size()),
      upper_(links.size()) {
  const std::size_t n = links.size();
  for (std::size_t i = 0; i < n; ++i) {
    diagonal_[i] = links[i].c + (i + 1 < n ? links[i + 1].a : 0);
    off_[i] = i + 1 < n ? links[i + 1].b : 0;
    single_ = single_ && off_[i] == 0;
    const double D = diagonal_[i] - (i > 0 ? factor_[i - 1] * off_[i - 1] : 0);
    inverse_[i] = 1 / D;
    factor_[i] = off_[i] / D;
  }
  if (!single_) followers_.resize(n + 1);
}

void LinkedMasses::accelerate(std::span<Vec2> f) const {
  const std::size_t n = f.size();
  if (single_) {
    for (std::size_t i = 0; i < n; ++i) f[i] = f[i] * inverse_[i];
    return;
  }
  for (std::size_t i = 1; i < n; ++i) f[i] = f[i] - f[i - 1] * factor_[i - 1];
  for (std::size_t i = 0; i < n; ++i) f[i] = f[i] * inverse_[i];
  for (std::size_t i = n - 1; i-- > 0;) f[i] = f[i] - f[i + 1] * factor_[i];
}

void LinkedMasses::correct(std::span<const Vec2> e, std::span<const Vec2> d, std::span<const double> change,
                           std::span<double> lambda, std::span<Vec2> move) {
  if (single_)
    eliminate_single(e, d, change, lambda, move);
  else
    eliminate_coupled(e, d, change, lambda, move);
}

void LinkedMasses::eliminate_single(std::span<const Vec2> e, std::span<const Vec2> d,
                                    std::span<const double> change, std::span<double> lambda,
                                    std::span<Vec2> move) {
  const std::size_t n = d.size();
  const auto& w = inverse_;
  for (std::size_t i = 0; i < n; ++i) {
    double pivot = w[i] * dot(e[i], d[i]), right = -change[i];
    if (i > 0) {
      const double lower = w[i - 1] * dot(e[i], d[i - 1]);
      pivot += w[i - 1] * dot(e[i], d[i]) - lower * upper_[i - 1];
      right += lower * lambda[i - 1];
    }
    const double pivot_inverse = 1 / pivot;
    lambda[i] = right * pivot_inverse;
    if (i + 1 < n) upper_[i] = w[i] * dot(e[i], d[i + 1]) * pivot_inverse;
  }
  for (std::size_t i = n - 1; i-- > 0;) lambda[i] += upper_[i] * lambda[i + 1];
  for (std::size_t i = 0; i + 1 < n; ++i) move[i] = (d[i + 1] * lambda[i + 1] - d[i] * lambda[i]) * w[i];
  move[n - 1] = d[n - 1] * (-lambda[n - 1] * w[n - 1]);
}

void LinkedMasses::eliminate_coupled(std::span<const Vec2> e, std::span<const Vec2> d,
                                     std::span<const double> change, std::span<double> lambda,
                                     std::span<Vec2> move) {
  const std::size_t n = d.size();
  for (std::size_t i = n; i-- > 0;) {
    const Follower& next = followers_[i + 1];
    const Vec2 d_next = i + 1 < n ? d[i + 1] : Vec2{};
    const double o = off_[i], o_before = i > 0 ? off_[i - 1] : 0;
    const double W_xx = diagonal_[i] + o * next.P_xx - d_next.x * next.l.x;
    const double W_xy = o * next.P_xy - d_next.x * next.l.y;
    const double W_yx = o * next.P_yx - d_next.y * next.l.x;
    const double W_yy = diagonal_[i] + o * next.P_yy - d_next.y * next.l.y;
    const Vec2 r = d_next * next.s - next.t * o;
    const double det_inverse = 1 / (W_xx * W_yy - W_xy * W_yx);
    const auto solved = [&](Vec2 b) {
      return Vec2{(W_yy * b.x - W_xy * b.y) * det_inverse, (W_xx * b.y - W_yx * b.x) * det_inverse};
    };
    // e^T W^-1, W^-1 d
    const Vec2 row{(e[i].x * W_yy - e[i].y * W_yx) * det_inverse,
                   (e[i].y * W_xx - e[i].x * W_xy) * det_inverse};
    const Vec2 column = solved(d[i]);
    const double inverse = 1 / dot(e[i], column);
    Follower& self = followers_[i];
    self.s = (dot(row, r) - change[i]) * inverse;
    self.l = (row * o_before + e[i]) * -inverse;
    const Vec2 x = solved({o_before, 0}), y = solved({0, o_before});
    self.t = solved(r) - column * self.s;
    self.P_xx = -x.x - column.x * self.l.x, self.P_xy = -y.x - column.x * self.l.y;
    self.P_yx = -x.y - column.y * self.l.x, self.P_yy = -y.y - column.y * self.l.y;
  }
  Vec2 before;
  for (std::size_t i = 0; i < n; ++i) {
    const Follower& self = followers_[i];
    lambda[i] = dot(self.l, before) + self.s;
    before = move[i] = Vec2{self.P_xx * before.x + self.P_xy * before.y + self.t.x,
                            self.P_yx * before.x + self.P_yy * before.y + self.t.y};
  }
}

}  // namespace chainreel
