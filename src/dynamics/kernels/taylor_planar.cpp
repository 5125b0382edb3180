#include "dynamics/kernels/taylor_planar.hpp"

#include <algorithm>
#include <type_traits>

#include "dynamics/kernels/taylor_planar_state.hpp"

namespace chainreel {
namespace {

struct QuadPair {
  Quad a = 0, b = 0;
  friend QuadPair operator+(const QuadPair& x, const QuadPair& y) { return {x.a + y.a, x.b + y.b}; }
  friend QuadPair operator-(const QuadPair& x, const QuadPair& y) { return {x.a - y.a, x.b - y.b}; }
  friend QuadPair operator*(const QuadPair& x, const QuadPair& y) { return {x.a * y.a, x.b * y.b}; }
  friend QuadPair operator*(const QuadPair& x, const Quad& k) { return {x.a * k, x.b * k}; }
  QuadPair& operator+=(const QuadPair& y) { return *this = *this + y; }
};

template <class Pack>
inline constexpr std::size_t kLinks = 1;

inline QuadPair turned(const QuadPair& x) {
  return {x.b, -x.a};
}
inline QuadPair pair_sums(const QuadPair& x) {
  return {x.a + x.b, x.a + x.b};
}
inline QuadPair spread(const QuadPair* row, std::size_t j) {
  return row[j];
}

}  // namespace
}  // namespace chainreel

#include "dynamics/kernels/taylor_planar_text.hpp"

namespace chainreel {
namespace {

template <class T>
struct PlaneVector {
  T x, y;
  friend PlaneVector operator+(const PlaneVector& a, const PlaneVector& b) { return {a.x + b.x, a.y + b.y}; }
  friend PlaneVector operator*(const PlaneVector& a, const T& k) { return {a.x * k, a.y * k}; }
};
template <class T>
T dot(const PlaneVector<T>& a, const PlaneVector<T>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class T>
T cross(const PlaneVector<T>& a, const PlaneVector<T>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class T>
PlaneVector<T> vector_of(const Eigen::Vector2d& a) {
  return {T(a.x()), T(a.y())};
}

template <class T>
void write_twice(AlignedNumbers<T>& rows, std::size_t at, const T& value) {
  rows[at] = rows[at + 1] = value;
}

template <class T>
ExpandPlanar<T> expand_for(int n) {
  if constexpr (std::is_same_v<T, double>) {
    return expand_doubles(n);
  } else if constexpr (std::is_same_v<T, DoubleDouble>) {
    return expand_double_doubles(n);
  } else
    return expand_planar_for<QuadPair, Quad>(n);
}

}  // namespace

std::optional<std::string> why_no_planar_series(const Chain& chain) {
  if (!chain.planar) return "the chain does not move in one plane";
  if (!chain.serial) return "the chain branches";
  if (chain.has_mimic) return "joints that follow others have no such series";
  if (chain.nv < 1) return "the chain has no joint";
  const auto& bodies = chain.planar->bodies;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Joint& joint = chain.bodies[i].joint;
    if (bodies[i].kind != JointKind::revolute) return "joint '" + joint.name + "' is not revolute";
    if (joint.friction != 0) return "joint '" + joint.name + "' has friction";
    if (bodies[i].parent + 1 != int(i) || bodies[i].q_index + 1 != int(i))
      return "its joints are not in the order of the chain";
  }
  return {};
}

template <class T>
PlanarSeriesState<T>::PlanarSeriesState(const Chain& chain, const AffineTorque& torque, int highest_order)
    : n(chain.nv) {
  const auto links = std::size_t(n);
  stride = 2 * links;
  const auto orders = std::size_t(highest_order + 1);
  for (AlignedNumbers<T>* matrix : {&A, &sigma_ij, &M}) matrix->resize(links * links);
  for (AlignedNumbers<T>* row_a_link : {&kappa, &sigma, &K, &D, &M_inv, &H_0, &H_1})
    row_a_link->resize(links * stride);
  for (AlignedNumbers<T>* row : {&pull, &S, &S_before, &R}) row->resize(stride);
  for (AlignedNumbers<T>* series : {&phi, &F, &E, &YX}) series->resize(orders * stride);
  sign.resize(links);
  inverse.resize(orders);
  for (std::size_t k = 1; k < orders; ++k) inverse[k] = T(1) / T(double(k));
  fold_links(chain);
  fold_torque(chain, torque);
}

template <class T>
void PlanarSeriesState<T>::fold_links(const Chain& chain) {
  const auto links = std::size_t(n);
  const PlaneVector<T> gravity{T(chain.gravity.dot(chain.planar->plane.ex)),
                          T(chain.gravity.dot(chain.planar->plane.ey))};
  const auto& bodies = chain.planar->bodies;
  std::vector<PlaneVector<T>> l(links), h(links);
  T carried(0);  // mass behind the link
  for (std::size_t i = links; i-- > 0;) {
    const PlanarBody& body = bodies[i + 1];
    const T mass(body.mass);
    const PlaneVector<T> com = vector_of<T>(body.com);
    l[i] = i + 1 < links ? vector_of<T>(bodies[i + 2].p_PJ) : PlaneVector<T>{T(0), T(0)};
    h[i] = com * mass + l[i] * carried;
    A[i * links + i] = T(body.inertia) + mass * dot(com, com) + carried * dot(l[i], l[i]);
    pull[2 * i] = -cross(h[i], gravity);
    pull[2 * i + 1] = -dot(h[i], gravity);
    sign[i] = T(body.sign);
    turned |= body.sign != 1;
    carried += mass;
  }
  for (std::size_t i = 0; i < links; ++i) {
    for (std::size_t j = 0; j < links; ++j) {
      if (i == j) continue;
      const PlaneVector<T>& u = i < j ? l[i] : h[i];
      const PlaneVector<T>& w = i < j ? h[j] : l[j];
      A[i * links + j] = dot(u, w);
      sigma_ij[i * links + j] = cross(u, w);
      along_x &= sigma_ij[i * links + j] == 0;
      write_twice(kappa, j * stride + 2 * i, dot(u, w));
      write_twice(sigma, j * stride + 2 * i, cross(u, w));
    }
  }
}

// Q_i = tau_i - tau_{i+1} about the normal, in phi: q_j = sign_j (phi_j - phi_{j-1}).
template <class T>
void PlanarSeriesState<T>::fold_torque(const Chain& chain, const AffineTorque& torque) {
  const auto links = std::size_t(n);
  for (const std::vector<Quad>& one : torque.powers) degree = std::max(degree, int(one.size()) - 1);
  powers.resize(std::size_t(degree + 1) * stride);
  const auto about_normal = [this](std::size_t i, const Quad& x) { return sign[i] < 0 ? -x : x; };
  const auto term = [&](const std::vector<Quad>& matrix, std::size_t i, std::size_t j, bool damped) {
    if (i >= links || j >= links) return Quad(0);
    const Quad damping = damped && i == j ? Quad(chain.bodies[i + 1].joint.damping) : Quad(0);
    return about_normal(i, about_normal(j, matrix[i * links + j] - damping));
  };
  // Both differences of one matrix: of rows for Q, of columns for phi.
  const auto folded = [&](const std::vector<Quad>& matrix, std::size_t i, std::size_t j, bool damped) {
    return (term(matrix, i, j, damped) - term(matrix, i + 1, j, damped)) -
           (term(matrix, i, j + 1, damped) - term(matrix, i + 1, j + 1, damped));
  };
  const auto power = [&](std::size_t i, std::size_t k) {
    return i < links && k < torque.powers[i].size() ? about_normal(i, torque.powers[i][k]) : Quad(0);
  };
  for (std::size_t i = 0; i < links; ++i) {
    for (std::size_t k = 0; k <= std::size_t(degree); ++k)
      write_twice(powers, k * stride + 2 * i, T(power(i, k) - power(i + 1, k)));
    for (std::size_t j = 0; j < links; ++j) {
      const Quad K_ij = folded(torque.K, i, j, false), D_ij = folded(torque.D, i, j, true);
      write_twice(K, j * stride + 2 * i, T(K_ij));
      write_twice(D, j * stride + 2 * i, T(D_ij));
      has_linear |= K_ij != 0 || D_ij != 0;
    }
  }
  Q = powers;
}

template <class T>
struct PlanarSeries<T>::State {
  State(const Chain& chain, const AffineTorque& torque, int highest_order)
      : numbers(chain, torque, highest_order), expand(expand_for<T>(chain.nv)) {}
  PlanarSeriesState<T> numbers;
  ExpandPlanar<T> expand;
};

template <class T>
PlanarSeries<T>::PlanarSeries(const Chain& chain, const AffineTorque& torque, int highest_order)
    : state_(std::make_unique<State>(chain, torque, highest_order)) {}

template <class T>
PlanarSeries<T>::~PlanarSeries() = default;
template <class T>
PlanarSeries<T>::PlanarSeries(PlanarSeries&&) noexcept = default;

template <class T>
void PlanarSeries<T>::expand(T t, std::span<const T> q, std::span<const T> v, int order, std::span<T> c) {
  state_->expand(state_->numbers, t, q.data(), v.data(), order, c.data());
}

template class PlanarSeries<double>;
template class PlanarSeries<DoubleDouble>;
template class PlanarSeries<Quad>;

}  // namespace chainreel
