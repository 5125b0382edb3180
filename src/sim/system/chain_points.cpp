#include "sim/system/chain_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/scalar.hpp"

namespace chainreel {
namespace {

using Eigen::Vector2d;

// Sine of the angle by which a centre of mass may be off its link: round-off of the file's rotations.
constexpr double kOffLine = 1e-12;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The angle of a turn by less than kLargeTurn from its sine: the series of the arc sine, whose next term is
// below half a unit in the last place.
constexpr double kLargeTurn = 0.15;
double arc_sine_of_small(double s) {
  constexpr double kSeries[] = {1.0 / 6,       3.0 / 40,      5.0 / 112,       35.0 / 1152,      63.0 / 2816,
                                231.0 / 13312, 143.0 / 10240, 6435.0 / 557056, 12155.0 / 1245184};
  const double z = s * s, z2 = z * z, z4 = z2 * z2;
  const double low = (kSeries[0] + z * kSeries[1]) + z2 * (kSeries[2] + z * kSeries[3]);
  const double high = (kSeries[4] + z * kSeries[5]) + z2 * (kSeries[6] + z * kSeries[7]);
  return s + s * z * (low + z4 * (high + z4 * kSeries[8]));
}

std::string joint_name(const Chain& chain, std::size_t i) {
  return "'" + chain.bodies[i].joint.name + "'";
}

// What keeps the chain from being points and links; nothing: ''.
std::string obstacle(const Chain& chain) {
  if (!chain.planar) return "this chain does not move in one plane (" + chain.why_algebra + ")";
  if (!chain.serial) return "this chain branches";
  if (chain.has_mimic) return "joints of this chain share a coordinate (mimic)";
  const std::vector<PlanarBody>& bodies = chain.planar->bodies;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const PlanarBody& body = bodies[i];
    if (body.kind != JointKind::revolute) return "joint " + joint_name(chain, i) + " slides";
    if (i + 1 == bodies.size()) {
      if (!(body.mass > 0)) return "the link behind joint " + joint_name(chain, i) + " has no mass";
      break;
    }
    const Vector2d& l = bodies[i + 1].p_PJ;
    if (l.norm() == 0)
      return "joints " + joint_name(chain, i) + " and " + joint_name(chain, i + 1) + " coincide";
    if (std::fabs(cross(l, body.com)) > kOffLine * l.norm() * (l.norm() + body.com.norm()))
      return "the centre of mass behind joint " + joint_name(chain, i) + " is beside the line of its link";
  }
  return {};
}

class ChainPoints final : public LinkedPoints {
 public:
  explicit ChainPoints(ChainSystem& system);

  // The mass matrix of the points must be positive definite: each must carry some.
  bool has_masses() const;

  std::span<const Link> links() const override { return links_; }
  bool force_depends_on_velocity() const override { return depends_on_velocity_; }
  void place(std::span<const double> q, std::span<const double> v, std::span<double> x,
             std::span<double> x_dot) override;
  void read(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
            std::span<double> v) override;
  void force(double t, std::span<const double> x, std::span<const double> x_dot,
             std::span<double> f) override;

 private:
  struct Shape {
    double u_x = 1, u_y = 0;            // the link's direction at q = 0
    double sign = 1;                    // of its joint's axis along the plane's normal
    double weight_x = 0, weight_y = 0;  // on the point at its end
    double inverse_square = 1;          // 1 / L^2
  };

  // A link as it was placed or read last: its end, itself, its absolute angle with what rounding cut off.
  struct Seen {
    double x = 0, y = 0, d_x = 0, d_y = 0, phi = 0, phi_carry = 0;
  };

  ChainSystem& system_;
  std::vector<Link> links_;
  std::vector<Shape> shapes_;
  std::vector<Seen> seen_;
  const bool depends_on_velocity_, is_constant_;
  std::vector<double> q_, v_;  // what torques see
};

ChainPoints::ChainPoints(ChainSystem& system)
    : system_(system),
      depends_on_velocity_(system.law().depends_on_velocity() || system.chain().has_dissipation),
      is_constant_(system.law().is_constant() && !system.chain().has_dissipation),
      q_(std::size_t(system.nv())),
      v_(std::size_t(system.nv())) {
  const Chain& chain = system.chain();
  const std::vector<PlanarBody>& bodies = chain.planar->bodies;
  const Vector2d gravity(chain.gravity.dot(chain.planar->plane.ex),
                         chain.gravity.dot(chain.planar->plane.ey));
  const std::size_t n = q_.size();
  links_.resize(n);
  shapes_.resize(n);
  seen_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PlanarBody& body = bodies[i + 1];
    const double m = body.mass, about_joint = body.inertia + m * body.com.squaredNorm();
    const bool is_last = i + 1 == n;
    const double reach = body.com.norm();
    Vector2d l = is_last ? body.com : bodies[i + 2].p_PJ;
    if (is_last) l = reach > 0 ? Vector2d(body.com * (about_joint / (m * reach * reach))) : Vector2d(1, 0);
    const double L = l.norm();
    const double along = body.com.dot(l) / L;  // d
    Link& link = links_[i];
    link.length = L;
    link.c = about_joint / (L * L);
    link.b = is_last && reach > 0 ? 0 : m * along / L - link.c;
    link.a = m - 2 * link.b - link.c;
    Shape& shape = shapes_[i];
    shape.u_x = l.x() / L, shape.u_y = l.y() / L;
    shape.sign = body.sign;
    shape.inverse_square = 1 / (L * L);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double mass = links_[i].b + links_[i].c + (i + 1 < n ? links_[i + 1].a + links_[i + 1].b : 0);
    shapes_[i].weight_x = mass * gravity.x();
    shapes_[i].weight_y = mass * gravity.y();
  }
}

bool ChainPoints::has_masses() const {
  constexpr double kLeast = 1e-12;  // of the mass at a point, that must be its own
  double D_before = 1;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const double diagonal = links_[i].c + (i + 1 < links_.size() ? links_[i + 1].a : 0);
    const double D = diagonal - (i > 0 ? links_[i].b * links_[i].b / D_before : 0);
    if (!(D > kLeast * diagonal)) return false;
    D_before = D;
  }
  return true;
}

void ChainPoints::place(std::span<const double> q, std::span<const double> v, std::span<double> x,
                        std::span<double> x_dot) {
  std::copy(q.begin(), q.end(), q_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  double phi = 0, rate = 0, end[2] = {0, 0}, end_dot[2] = {0, 0};
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Shape& shape = shapes_[i];
    Seen& seen = seen_[i];
    phi += shape.sign * q[i];
    rate += shape.sign * v[i];
    const auto [s, c] = sin_cos(phi);
    seen.d_x = links_[i].length * (shape.u_x * c - shape.u_y * s);
    seen.d_y = links_[i].length * (shape.u_x * s + shape.u_y * c);
    seen.x = x[2 * i] = end[0] += seen.d_x;
    seen.y = x[2 * i + 1] = end[1] += seen.d_y;
    seen.phi = phi, seen.phi_carry = 0;
    x_dot[2 * i] = end_dot[0] -= rate * seen.d_y;
    x_dot[2 * i + 1] = end_dot[1] += rate * seen.d_x;
  }
}

void ChainPoints::read(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
                       std::span<double> v) {
  double phi_before = 0, rate_before = 0, turn_before[2] = {0, 0};
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Shape& shape = shapes_[i];
    Seen& seen = seen_[i];
    const double moved_x = x[2 * i] - seen.x, moved_y = x[2 * i + 1] - seen.y;
    const double turn_x = moved_x - turn_before[0], turn_y = moved_y - turn_before[1];
    const double s = (seen.d_x * turn_y - seen.d_y * turn_x) * shape.inverse_square;
    const double advance = (seen.d_x * turn_x + seen.d_y * turn_y) * shape.inverse_square;  // cos - 1
    const double angle = s * s < kLargeTurn * kLargeTurn && advance > -0.5 ? arc_sine_of_small(s)
                                                                           : arc_tangent2(s, 1 + advance);
    const double phi = seen.phi;
    seen.phi_carry += angle;
    seen.phi = phi + seen.phi_carry;
    seen.phi_carry += phi - seen.phi;
    seen.x = x[2 * i], seen.y = x[2 * i + 1];
    seen.d_x = i > 0 ? seen.x - seen_[i - 1].x : seen.x;
    seen.d_y = i > 0 ? seen.y - seen_[i - 1].y : seen.y;
    const double v_x = x_dot[2 * i] - (i > 0 ? x_dot[2 * i - 2] : 0);
    const double v_y = x_dot[2 * i + 1] - (i > 0 ? x_dot[2 * i - 1] : 0);
    const double rate = (seen.d_x * v_y - seen.d_y * v_x) * shape.inverse_square;
    q[i] = shape.sign * (seen.phi - phi_before);
    v[i] = shape.sign * (rate - rate_before);
    phi_before = seen.phi, rate_before = rate;
    turn_before[0] = moved_x, turn_before[1] = moved_y;
  }
}

void ChainPoints::force(double t, std::span<const double> x, std::span<const double> x_dot,
                        std::span<double> f) {
  system_.count_evaluation();
  if (!is_constant_) read(x, x_dot, q_, v_);
  const ConstVec tau = system_.net_torque(t, q_, v_);
  const std::size_t n = links_.size();
  for (std::size_t i = 0; i < n; ++i) f[2 * i] = shapes_[i].weight_x, f[2 * i + 1] = shapes_[i].weight_y;
  for (std::size_t i = 0; i < n; ++i) {
    const double couple = (shapes_[i].sign * tau[i] - (i + 1 < n ? shapes_[i + 1].sign * tau[i + 1] : 0)) *
                          shapes_[i].inverse_square;
    const double d_x = x[2 * i] - (i > 0 ? x[2 * i - 2] : 0), d_y = x[2 * i + 1] - (i > 0 ? x[2 * i - 1] : 0);
    const double f_x = -couple * d_y, f_y = couple * d_x;
    f[2 * i] += f_x, f[2 * i + 1] += f_y;
    if (i > 0) f[2 * i - 2] -= f_x, f[2 * i - 1] -= f_y;
  }
}

}  // namespace

std::unique_ptr<LinkedPoints> make_chain_points(ChainSystem& system, const std::string& method) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::bad_input, "the method " + method +
                                         " takes planar chains of point masses and rods, and " + why +
                                         ": take dop853");
  };
  if (const std::string why = obstacle(system.chain()); !why.empty()) refuse(why);
  auto points = std::make_unique<ChainPoints>(system);
  if (!points->has_masses()) refuse("an end of a link of this one would have no mass");
  return points;
}

}  // namespace chainreel
