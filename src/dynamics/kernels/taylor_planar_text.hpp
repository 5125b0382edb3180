// The recurrence of taylor_planar.hpp over packs of numbers: private to the files that include it, each with
// packs of its own, so that one text is compiled for pairs of doubles, of DoubleDoubles and of Quads.
//
// A pack holds the lanes of one link or of more. Besides + - * of packs, and * with a number, it has
//   turned(x)        (s, c) -> (c, -s) in each pair of lanes
//   pair_sums(x)     in both lanes of each pair their sum
//   spread(row, j)   in each pair of lanes the pair of link j
//   kLinks<Pack>     links in one pack
#pragma once

#include "core/scalar.hpp"
#include "dynamics/kernels/taylor_planar_state.hpp"

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

  explicit PlanarRecurrence(State& state)
      : w_(state),
        shape_(state.n),
        S_(state.S.data()),
        S_before_(state.S_before.data()),
        R_(state.R.data()) {}

  void expand(T t, const T* q, const T* v, int order, T* c) {
    begin(q, v);
    if (w_.degree > 0) move_torque(t);
    invert_mass_matrix();
    fold_late_terms();
    for (int k = 0; k + 2 <= order; ++k) find_next(k);
    write_joint_angles(order, c);
  }

 private:
  // Pack p of row k.
  Pack& at(AlignedNumbers<T>& rows, int k, std::size_t p) const { return row(rows, k)[p]; }
  Pack* row(AlignedNumbers<T>& rows, int k) const {
    return reinterpret_cast<Pack*>(rows.data() + std::size_t(k) * w_.stride);
  }

  // phi and E of orders 0 and 1.
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
      S_before_[p] = at(w_.E, 0, p) * at(w_.phi, 1, p);
      at(w_.E, 1, p) = turned(S_before_[p]);
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

  // kappa (s_j, c_j) + sigma (c_j, -s_j), summed over j: what a row of pairs gives to (Y, X).
  Pack coupled(const Pack* pairs, std::size_t p) const {
    Pack sum = at(w_.kappa, 0, p) * spread(pairs, 0);
    for (std::size_t j = 1; j < shape_.links; ++j) sum += at(w_.kappa, int(j), p) * spread(pairs, j);
    if (!w_.along_x)
      for (std::size_t j = 0; j < shape_.links; ++j)
        sum += at(w_.sigma, int(j), p) * turned(spread(pairs, j));
    return sum;
  }

  // M^-1 x, for x twice in each pair.
  Pack solved(const Pack* x, std::size_t p) const {
    Pack sum = at(w_.M_inv, 0, p) * spread(x, 0);
    for (std::size_t j = 1; j < shape_.links; ++j) sum += at(w_.M_inv, int(j), p) * spread(x, j);
    return sum;
  }

  // E[m] times what coupled() takes of pairs j, through M^-1, for m = 0 and 1: two matrices of pairs.
  void fold_late_terms() {
    for (int m = 0; m < 2; ++m) {
      for (std::size_t j = 0; j < shape_.links; ++j) {
        for (std::size_t p = 0; p < shape_.packs; ++p) {
          const Pack& E = at(w_.E, m, p);
          R_[p] = at(w_.kappa, int(j), p) * E;
          if (!w_.along_x) R_[p] = R_[p] - at(w_.sigma, int(j), p) * turned(E);
        }
        for (std::size_t p = 0; p < shape_.packs; ++p)
          at(m == 0 ? w_.H_0 : w_.H_1, int(j), p) = solved(R_.data(), p);
      }
    }
  }

  // The part of the sums whose factors are of orders 2 to k: S of (k + 2) (s, c)[k+2], R of what stands
  // beside phi'' in order k. Two sums each, so that additions need not wait for one another.
  void convolve(int k, std::size_t p, Pack& S, Pack& R) const {
    const std::size_t stride = w_.stride / (2 * kLinks<Pack>);
    const Pack* F = row(w_.F, 2) + p;
    const Pack* YX = row(w_.YX, 0) + p;
    const Pack* E = row(w_.E, k) + p;
    Pack S_odd{}, R_odd{};
    S = R = Pack{};
    int j = 2;
    for (; j < k; j += 2) {
      S += F[0] * E[0];
      R += YX[0] * E[0];
      S_odd += F[stride] * *(E - stride);
      R_odd += YX[stride] * *(E - stride);
      F += 2 * stride, YX += 2 * stride, E -= 2 * stride;
    }
    if (j == k) {
      S += F[0] * E[0];
      R += YX[0] * E[0];
    }
    S += S_odd;
    R += R_odd;
  }

  // Order k of the equations: phi[k+2], s and c of order k + 2, Y and X of order k.
  //
  // Each order waits for the one before it, so what has just been computed takes a short way: E[0] (Y, X)[k]
  // and E[1] (Y, X)[k-1] are multiples of (s, c)[k+2] and (s, c)[k+1], folded with M^-1 before.
  void find_next(int k) {
    const T inverse_1 = w_.inverse[std::size_t(k + 1)], inverse_2 = w_.inverse[std::size_t(k + 2)];
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      convolve(k, p, S_[p], R_[p]);
      if (k < 2) R_[p] += at(w_.E, k, p) * at(w_.pull, 0, p);
      R_[p] = torque(k, p) - pair_sums(R_[p]);
      if (k > 0) S_[p] += at(w_.F, 1, p) * at(w_.E, k + 1, p);
      S_[p] += at(w_.F, k + 1, p) * at(w_.E, 1, p);
      S_before_[p] = S_before_[p] * (T(double(k)) * inverse_1);
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      Pack late = at(w_.H_1, 0, p) * spread(S_before_.data(), 0);
      for (std::size_t j = 1; j < shape_.links; ++j)
        late += at(w_.H_1, int(j), p) * spread(S_before_.data(), j);
      for (std::size_t j = 0; j < shape_.links; ++j) late += at(w_.H_0, int(j), p) * spread(S_.data(), j);
      at(w_.F, k + 2, p) = solved(R_.data(), p) * inverse_1 - pair_sums(late);
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      const Pack F = at(w_.F, k + 2, p);
      at(w_.phi, k + 2, p) = F * inverse_2;
      S_[p] += at(w_.E, 0, p) * F;
      at(w_.E, k + 2, p) = turned(S_[p] * inverse_2);
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) {
      Pack YX = coupled(S_.data(), p) * T(double(k + 1));
      if (k == 0) YX += at(w_.pull, 0, p);
      at(w_.YX, k, p) = YX;
    }
    for (std::size_t p = 0; p < shape_.packs; ++p) S_before_[p] = S_[p];
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
  Row<Pack, n> S_, S_before_, R_;
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
