// The recurrence of taylor_planar.hpp over packs of numbers: private to the files that include it, each with
// packs of its own, so that one text is compiled for pairs of doubles, for fours and for pairs of Quads.
//
// A pack holds the lanes of one link or of more. Besides + - * of packs, and * with a number, it has
//   turned(x)        (s, c) -> (c, -s) in each pair of lanes
//   pair_sums(x)     in both lanes of each pair their sum
//   spread(row, j)   in each pair of lanes the pair of link j
//   kLinks<Pack>     links in one pack
#pragma once

#include "core/scalar.hpp"
#include "dynamics/taylor_planar_state.hpp"

namespace chainreel {
namespace {

// The number of links, and of packs in a row: known while compiling for small chains (n > 0).
template <class Pack, int n>
struct Shape {
  explicit Shape(int) {}
  static constexpr std::size_t links = std::size_t(n);
  static constexpr std::size_t packs = (links + kLinks<Pack> - 1) / kLinks<Pack>;
};
template <class Pack>
struct Shape<Pack, 0> {
  explicit Shape(int n) : links(std::size_t(n)), packs((links + kLinks<Pack> - 1) / kLinks<Pack>) {}
  std::size_t links, packs;
};

// A row that lives in registers where its length is known, else at `memory`.
template <class Pack, int n>
struct Row {
  explicit Row(void*) {}
  Pack packs[Shape<Pack, n>::packs];
  Pack& operator[](std::size_t p) { return packs[p]; }
  const Pack* data() const { return packs; }
};
template <class Pack>
struct Row<Pack, 0> {
  explicit Row(void* memory) : packs(static_cast<Pack*>(memory)) {}
  Pack* packs;
  Pack& operator[](std::size_t p) { return packs[p]; }
  const Pack* data() const { return packs; }
};

template <class Pack, class T, int n>
class PlanarRecurrence {
 public:
  using State = PlanarSeriesState<T>;

  PlanarRecurrence(State& state) : w_(state), shape_(state.n), S_(state.S.data()), R_(state.R.data()) {}

  void expand(T t, const T* q, const T* v, int order, T* c) {
    begin(q, v);
    move_torque(t);
    invert_mass_matrix();
    for (int k = 0; k + 2 <= order; ++k) find_next(k);
    write_joint_angles(order, c);
  }

 private:
  // Pack p of row k.
  Pack& at(AlignedNumbers<T>& rows, int k, std::size_t p) const { return row(rows, k)[p]; }
  Pack* row(AlignedNumbers<T>& rows, int k) const {
    return reinterpret_cast<Pack*>(rows.data() + std::size_t(k) * w_.stride);
  }

  // phi, E of orders 0 and 1.
  void begin(const T* q, const T* v) {
    T angle(0), rate(0);
    T* const phi_0 = w_.phi.data();
    T* const phi_1 = phi_0 + w_.stride;
    T* const E_0 = w_.E.data();
    for (std::size_t i = 0; i < shape_.links; ++i) {
      angle += w_.sign[i] * q[i];
      rate += w_.sign[i] * v[i];
      const auto [s, c] = sin_cos(angle);
      E_0[2 * i] = c, E_0[2 * i + 1] = -s;
      phi_0[2 * i] = phi_0[2 * i + 1] = angle;
      phi_1[2 * i] = phi_1[2 * i + 1] = rate;
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      at(w_.F, 1, p) = at(w_.phi, 1, p);
      at(w_.E, 1, p) = turned(at(w_.E, 0, p) * at(w_.phi, 1, p));
    }
  }

  // The polynomials in t about this instant, by repeated synthetic division.
  void move_torque(T t) {
    const std::size_t size = std::size_t(w_.degree + 1) * w_.stride;
    for (std::size_t i = 0; i < size; ++i) w_.Q[i] = w_.powers[i];
    for (int first = 0; first < w_.degree; ++first)
      for (int k = w_.degree - 1; k >= first; --k)
        for (std::size_t p = 0; p < shape_.packs; ++p) at(w_.Q, k, p) += at(w_.Q, k + 1, p) * t;
  }

  void invert_mass_matrix() {
    const std::size_t size = shape_.links;
    const T* const E_0 = w_.E.data();
    const T* const A = w_.A.data();
    T* const M = w_.M.data();
    for (std::size_t i = 0; i < size; ++i) {
      M[i * size + i] = A[i * size + i];
      for (std::size_t j = 0; j < i; ++j) {
        const T &c_i = E_0[2 * i], &c_j = E_0[2 * j], minus_s_i = E_0[2 * i + 1], minus_s_j = E_0[2 * j + 1];
        T M_ij = A[i * size + j] * (c_i * c_j + minus_s_i * minus_s_j);
        if (!w_.along_x) M_ij += w_.sigma_ij[i * size + j] * (c_i * minus_s_j - minus_s_i * c_j);
        M[i * size + j] = M[j * size + i] = M_ij;
      }
    }
    if constexpr (n == 2)
      invert_two(M);
    else
      invert(M, size);
    T* const M_inv = w_.M_inv.data();
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t i = 0; i < size; ++i)
        M_inv[j * w_.stride + 2 * i] = M_inv[j * w_.stride + 2 * i + 1] = M[i * size + j];
  }

  static void invert_two(T* M) {
    const T det_inv = T(1) / (M[0] * M[3] - M[1] * M[1]);
    const T M_11 = M[0];
    M[0] = M[3] * det_inv;
    M[3] = M_11 * det_inv;
    M[1] = M[2] = -M[1] * det_inv;
  }

  // Gauss and Jordan's elimination in place; M is positive definite, so its diagonal may be the pivots.
  static void invert(T* M, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
      const T pivot = T(1) / M[k * size + k];
      M[k * size + k] = T(1);
      for (std::size_t j = 0; j < size; ++j) M[k * size + j] *= pivot;
      for (std::size_t i = 0; i < size; ++i) {
        if (i == k) continue;
        const T factor = M[i * size + k];
        M[i * size + k] = T(0);
        for (std::size_t j = 0; j < size; ++j) M[i * size + j] -= factor * M[k * size + j];
      }
    }
  }

  // sum_j of kappa_ij (s_j, c_j) + sigma_ij (c_j, -s_j): what the pairs of a row give to (Y, X).
  Pack coupled(const Pack* pairs, std::size_t p) const {
    Pack sum{};
    for (std::size_t j = 0; j < shape_.links; ++j) {
      const Pack pair = spread(pairs, j);
      sum += at(w_.kappa, int(j), p) * pair;
      if (!w_.along_x) sum += at(w_.sigma, int(j), p) * turned(pair);
    }
    return sum;
  }

  // Products of the orders below, for s and c of order k + 2 and for c Y - s X of order k. Two sums each, so
  // that additions need not wait for one another; what has just been computed comes last.
  void convolve(int k, std::size_t p, Pack& S, Pack& R) const {
    const Pack* const F = row(w_.F, 0) + p;
    const Pack* const E = row(w_.E, 0) + p;
    const Pack* const YX = row(w_.YX, 0) + p;
    Pack S_odd{}, R_odd{};
    S = R = Pack{};
    int j = k;
    for (; j >= 3; j -= 2) {
      S += of(F, j) * of(E, k + 2 - j);
      R += of(E, j) * of(YX, k - j);
      S_odd += of(F, j - 1) * of(E, k + 3 - j);
      R_odd += of(E, j - 1) * of(YX, k + 1 - j);
    }
    for (; j >= 1; --j) {
      S += of(F, j) * of(E, k + 2 - j);
      R += of(E, j) * of(YX, k - j);
    }
    R += R_odd;
    S += S_odd;
    S += of(F, k + 1) * of(E, 1);
  }

  // Row k of a series, from its pack in row 0 on.
  const Pack& of(const Pack* series, int k) const {
    return series[std::size_t(k) * (w_.stride / (2 * kLinks<Pack>))];
  }

  // Order k of the equations: phi[k+2], s and c of order k + 2, Y and X of order k.
  void find_next(int k) {
    const T twice = T(double((k + 1) * (k + 2)));
    Row<Pack, n> S = S_, R = R_;
    for (std::size_t p = 0; p < shape_.packs; ++p) convolve(k, p, S[p], R[p]);
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      Pack YX = coupled(S.data(), p) * T(double(k + 1));
      if (k == 0) YX += at(w_.pull, 0, p);
      R[p] = torque(k, p) - pair_sums(R[p] + at(w_.E, 0, p) * YX);
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      Pack phi_dd{};
      for (std::size_t j = 0; j < shape_.links; ++j) phi_dd += at(w_.M_inv, int(j), p) * spread(R.data(), j);
      at(w_.F, k + 2, p) = phi_dd * w_.inverse[std::size_t(k + 1)];
      at(w_.phi, k + 2, p) = at(w_.F, k + 2, p) * w_.inverse[std::size_t(k + 2)];
      S[p] = S[p] * w_.inverse[std::size_t(k + 2)] + at(w_.E, 0, p) * at(w_.phi, k + 2, p);
      at(w_.E, k + 2, p) = turned(S[p]);
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      at(w_.YX, k, p) = coupled(S.data(), p) * twice;
      if (k == 0) at(w_.YX, k, p) += at(w_.pull, 0, p);
    }
  }

  // Q[k].
  Pack torque(int k, std::size_t p) const {
    Pack Q{};
    if (k <= w_.degree) Q = at(w_.Q, k, p);
    if (!w_.has_linear) return Q;
    for (std::size_t j = 0; j < shape_.links; ++j) {
      Q += at(w_.K, int(j), p) * spread(row(w_.phi, k), j);
      Q += at(w_.D, int(j), p) * spread(row(w_.F, k + 1), j);
    }
    return Q;
  }

  void write_joint_angles(int order, T* c) const {
    for (int k = 0; k <= order; ++k) {
      const T* const phi = w_.phi.data() + std::size_t(k) * w_.stride;
      T before(0);
      for (std::size_t i = 0; i < shape_.links; ++i) {
        const T difference = phi[2 * i] - before;
        *c++ = w_.turned ? w_.sign[i] * difference : difference;
        before = phi[2 * i];
      }
    }
  }

  State& w_;
  Shape<Pack, n> shape_;
  Row<Pack, n> S_, R_;
};

template <class Pack, class T, int n>
void expand_planar(PlanarSeriesState<T>& state, T t, const T* q, const T* v, int order, T* c) {
  PlanarRecurrence<Pack, T, n>(state).expand(t, q, v, order, c);
}

template <class Pack, class T>
ExpandPlanar<T> expand_planar_for(int n) {
  switch (n) {
    case 1:
      return expand_planar<Pack, T, 1>;
    case 2:
      return expand_planar<Pack, T, 2>;
    case 3:
      return expand_planar<Pack, T, 3>;
    case 4:
      return expand_planar<Pack, T, 4>;
    default:
      return expand_planar<Pack, T, 0>;
  }
}

}  // namespace
}  // namespace chainreel
