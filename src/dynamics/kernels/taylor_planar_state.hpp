// What the text of the recurrence reads and writes: the folded model, and room for the series.
#pragma once

#include <cstddef>
#include <vector>

#include "core/double_double.hpp"
#include "dynamics/kernels/taylor_planar.hpp"

namespace chainreel {

// Numbers from an aligned address on.
template <class T>
class AlignedNumbers {
 public:
  void resize(std::size_t size) { blocks_.resize((size * sizeof(T) + kBytes - 1) / kBytes); }
  T* data() { return blocks_.data()->numbers; }
  const T* data() const { return blocks_.data()->numbers; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  static constexpr std::size_t kBytes = 64;  // the widest vector, and a line of the cache
  struct alignas(kBytes) Block {
    T numbers[kBytes / sizeof(T)] = {};
  };
  std::vector<Block> blocks_;
};

// A row has two lanes for each link: (s, c), (Y, X), or one number twice; `stride` numbers with what fills
// the last pack, which is zero.
template <class T>
struct PlanarSeriesState {
  PlanarSeriesState(const Chain& chain, const AffineTorque& torque, int highest_order);

  // The model.
  int n = 0;
  std::size_t stride = 0;
  int degree = 0;                  // of the torques in t
  bool along_x = true;             // every sigma is zero
  bool has_linear = false;         // some of K or D is not zero
  bool turned = false;             // some sign is -1
  AlignedNumbers<T> A;             // n x n: A_ii on the diagonal, kappa elsewhere
  AlignedNumbers<T> sigma_ij;      // n x n
  AlignedNumbers<T> sign;          // n: of the joint's axis along the normal
  AlignedNumbers<T> kappa, sigma;  // row j: of all i with j; zero at i = j
  AlignedNumbers<T> pull;          // a row: (-pull_c, -pull_s)
  AlignedNumbers<T> powers;        // row k: of Q in t^k
  AlignedNumbers<T> K, D;          // row j: of Q in phi_j and phi_j'
  AlignedNumbers<T> inverse;       // 1/k

  // The series: row k holds the coefficients of t^k.
  AlignedNumbers<T> phi;             // twice
  AlignedNumbers<T> F;               // k phi[k], twice
  AlignedNumbers<T> E;               // (c, -s)
  AlignedNumbers<T> YX;              // (Y, X)
  AlignedNumbers<T> Q;               // twice; of time alone, up to the degree
  AlignedNumbers<T> M;               // n x n, its inverse at the end
  AlignedNumbers<T> M_inv;           // row j, twice
  AlignedNumbers<T> H_0, H_1;        // row j: of M^-1 times what pairs j give
  AlignedNumbers<T> S, S_before, R;  // rows: sums of products

 private:
  void fold_links(const Chain& chain);
  void fold_torque(const Chain& chain, const AffineTorque& torque);
};

// Coefficients of phi up to the order into `c`, as joint angles.
template <class T>
using ExpandPlanar = void (*)(PlanarSeriesState<T>& state, T t, const T* q, const T* v, int order, T* c);

ExpandPlanar<double> expand_doubles(int n);
ExpandPlanar<DoubleDouble> expand_double_doubles(int n);

}  // namespace chainreel
