#include "symbols/parameters.hpp"

#include <cln/cln.h>

#include <cmath>
#include <optional>

#include "model/planar.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;
using GiNaC::ex;
using GiNaC::numeric;

// Relative: files have 15 digits at most, and transforms are lumped with the round-off of a few products.
constexpr double kSame = 1e-9;
const char* const kAxes[] = {"x", "y", "z"};

bool is_same(double a, double b, double scale) {
  return std::abs(a - b) <= kSame * scale;
}

// A vector as letter_index along its only axis, or one symbol a component.
struct Naming {
  std::string letter, index, unit, meaning;
  SymbolKind kind;
};

Algebra3 name_vector(const Vector3d& v, const Naming& naming, Symbols& symbols) {
  Algebra3 named{0, 0, 0};
  const auto is_there = [&](int k) { return std::abs(v[k]) > kSame * v.norm(); };
  const int count = int(is_there(0)) + int(is_there(1)) + int(is_there(2));
  for (int k = 0; k < 3; ++k) {
    if (!is_there(k)) continue;
    const std::string index = count == 1 ? naming.index : naming.index + (naming.index.empty() ? "" : ",") + kAxes[k];
    const std::string along = count == 1 ? "" : std::string(", along ") + kAxes[k];
    // One symbol is a length, and positive; where there are several each has its sign.
    const int sign = count == 1 && v[k] < 0 ? -1 : 1;
    named[std::size_t(k)] =
        sign * symbols.add({naming.letter, index, naming.kind, sign * v[k], naming.unit, naming.meaning + along});
  }
  return named;
}

// What leads from a body to another joint or to the end effector.
struct Way {
  int from = 0;
  Vector3d v;
  Algebra3 named;
};

class Namer {
 public:
  Namer(const Chain& chain, Symbols& symbols) : chain_(chain), symbols_(symbols) {}

  ChainParameters name() {
    ChainParameters named;
    named.bodies.resize(chain_.bodies.size());
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) {
      const Body& body = chain_.bodies[i];
      named.bodies[i].joint = name_way(body.parent, in_motion(body.parent, body.joint.X_PJ.translation()),
                                       place_of_joint(i), "to " + body.joint.name);
    }
    if (chain_.end_effector >= 0) {
      const Frame& frame = chain_.frames[std::size_t(chain_.end_effector)];
      const std::string index = children_of(frame.body) == 0 ? std::to_string(frame.body) : "e";
      named.end_effector = name_way(frame.body, in_motion(frame.body, frame.X_BF.translation()), index, "to " + frame.name);
    }
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) name_body(i, named.bodies[i]);
    named.gravity = name_vector(chain_.gravity, {"g", "", "m/s^2", "gravity", SymbolKind::gravity}, symbols_);
    return named;
  }

 private:
  int children_of(int body) const {
    int count = 0;
    for (std::size_t i = 1; i < chain_.bodies.size(); ++i) count += chain_.bodies[i].parent == body;
    return count;
  }
  std::string place_of_joint(std::size_t i) const {
    const int parent = chain_.bodies[i].parent;
    return std::to_string(parent) + (children_of(parent) > 1 ? "," + std::to_string(i) : "");
  }

  // What of a vector of a body matters: nothing along the normal of a planar chain.
  Vector3d in_motion(int body, const Vector3d& v) const {
    if (!chain_.planar) return v;
    const Vector3d n = chain_.planar->X_WB_zero[std::size_t(body)].linear().transpose() * chain_.planar->plane.normal;
    const Vector3d rest = v - n.dot(v) * n;
    return rest.norm() > kSame * v.norm() ? rest : Vector3d(Vector3d::Zero());
  }

  Algebra3 name_way(int from, const Vector3d& v, const std::string& index, const std::string& to) {
    const std::string of = from == 0 ? "from the base " : "of " + chain_.bodies[std::size_t(from)].name + " ";
    ways_.push_back({from, v, name_vector(v, {"L", index, "m", "length " + of + to, SymbolKind::length}, symbols_)});
    return ways_.back().named;
  }

  // "link2 with its payload"
  std::string whose(std::size_t i) const {
    const bool carries = std::any_of(chain_.point_masses.begin(), chain_.point_masses.end(), [&](const PointMass& one) { return one.is_payload && one.body == int(i); });
    return chain_.bodies[i].name + (carries ? " with its payload" : "");
  }

  // The centre of mass at the end or in the middle of the body's way is said by that.
  Algebra3 name_com(std::size_t i, const Vector3d& com) {
    for (const auto& [share, factor] : {std::pair{1.0, numeric(1)}, {0.5, numeric(1, 2)}})
      for (const Way& way : ways_)
        if (way.from == int(i) && way.v.norm() > 0 && (com - share * way.v).norm() <= kSame * way.v.norm())
          return {factor * way.named[0], factor * way.named[1], factor * way.named[2]};
    return name_vector(com, {"c", std::to_string(i), "m", "centre of mass of " + whose(i), SymbolKind::length}, symbols_);
  }

  // A rod's about its middle, by its mass and length; nothing where it is no rod's.
  std::optional<ex> rod_inertia(std::size_t i, double inertia, const BodyParameters& named) const {
    for (const Way& way : ways_) {
      if (way.from != int(i)) continue;
      const double rod = chain_.bodies[i].inertia.mass * way.v.squaredNorm() / 12;
      if (rod > 0 && is_same(inertia, rod, rod))
        return named.mass * (way.named[0] * way.named[0] + way.named[1] * way.named[1] + way.named[2] * way.named[2]) / 12;
    }
    return std::nullopt;
  }

  void name_inertia(std::size_t i, BodyParameters& named) {
    const Body& body = chain_.bodies[i];
    const std::string of = "of " + whose(i) + " about its centre of mass";
    const double size = body.inertia.about_com.trace();
    named.planar_inertia = 0;
    for (Algebra3& row : named.inertia) row = {0, 0, 0};
    if (chain_.planar) {
      const double inertia = chain_.planar->bodies[i].inertia;
      if (!(inertia > kSame * size)) return;
      const auto rod = rod_inertia(i, inertia, named);
      named.planar_inertia =
          rod ? *rod
              : symbols_.add({"I", std::to_string(i), SymbolKind::inertia, inertia, "kg m^2", "moment of inertia " + of});
      return;
    }
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c) {
        const double entry = body.inertia.about_com(r, c);
        if (!(std::abs(entry) > kSame * size)) continue;
        const std::string index = std::to_string(i) + "," + kAxes[r] + kAxes[c];
        named.inertia[std::size_t(r)][std::size_t(c)] = named.inertia[std::size_t(c)][std::size_t(r)] =
            symbols_.add({"I", index, SymbolKind::inertia, entry, "kg m^2", std::string(r == c ? "moment" : "product") + " of inertia " + of});
      }
  }

  void name_body(std::size_t i, BodyParameters& named) {
    const Body& body = chain_.bodies[i];
    const std::string index = std::to_string(i);
    named.mass = 0;
    if (body.inertia.mass > 0)
      named.mass = symbols_.add({"m", index, SymbolKind::mass, body.inertia.mass, "kg", "mass of " + whose(i)});
    named.com = name_com(i, in_motion(int(i), body.inertia.com));
    name_inertia(i, named);
    const bool turns = body.joint.kind == JointKind::revolute;
    named.damping = named.friction = 0;
    if (body.joint.damping != 0)
      named.damping = symbols_.add({"d", index, SymbolKind::damping, body.joint.damping, turns ? "N m s/rad" : "N s/m",
                                    "damping of " + body.joint.name});
    if (body.joint.friction != 0)
      named.friction = symbols_.add({"f", index, SymbolKind::friction, body.joint.friction, turns ? "N m" : "N",
                                     "friction of " + body.joint.name});
  }

  const Chain& chain_;
  Symbols& symbols_;
  std::vector<Way> ways_;
};

}  // namespace

ex Symbols::add(Symbol symbol) {
  // Its name is never read: GiNaC tells symbols apart by themselves.
  twins_.emplace_back(symbol.letter + symbol.index);
  list_.push_back(std::move(symbol));
  return twins_.back();
}

numeric exact_number(double value) {
  for (const numeric& simple : {numeric(0), numeric(1), numeric(-1), numeric(1, 2), numeric(-1, 2)})
    if (std::abs(value - simple.to_double()) <= kParallelTolerance) return simple;
  return numeric(cln::rational(cln::cl_DF(value)));
}

ChainParameters parameters_of(const Chain& chain, Symbols& symbols) {
  return Namer(chain, symbols).name();
}

}  // namespace chainreel
