#include "model/reduce.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/format.hpp"
#include "model_file.hpp"

namespace chainreel {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct PointMass {
  double mass = 0;
  Vector3d at;
};

// Six point masses with the mass, centre and inertia of a rigid body: two on each principal axis, as far out
// as the second moment along it asks for, int x^2 dm = (I2 + I3 - I1) / 2.
void add_points(const Inertia& body, const Isometry3d& X, std::vector<PointMass>& points) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(body.about_com);
  const Vector3d I = solver.eigenvalues();
  for (int k = 0; k < 3; ++k) {
    const double second_moment = 0.5 * (I.sum() - 2 * I[k]);
    const Vector3d arm =
        std::sqrt(3 * std::max(second_moment, 0.0) / body.mass) * solver.eigenvectors().col(k);
    points.push_back({body.mass / 6, X * (body.com + arm)});
    points.push_back({body.mass / 6, X * (body.com - arm)});
  }
}

Inertia inertia_of(const std::vector<PointMass>& points) {
  Inertia sum;
  for (const PointMass& p : points) {
    sum.mass += p.mass;
    sum.com += p.mass * p.at;
  }
  sum.com /= sum.mass;
  for (const PointMass& p : points) {
    const Vector3d d = p.at - sum.com;
    sum.about_com += p.mass * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  }
  return sum;
}

double largest_difference(const Inertia& a, const Inertia& b) {
  return std::max({std::fabs(a.mass - b.mass), (a.com - b.com).cwiseAbs().maxCoeff(),
                   (a.about_com - b.about_com).cwiseAbs().maxCoeff()});
}

class RandomParts {
 public:
  explicit RandomParts(unsigned seed) : generator_(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Vector3d vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator_); }
  Inertia inertia() {
    std::vector<PointMass> points;
    for (int i = 0; i < 5; ++i) points.push_back({number(0.1, 1), vector(0.5)});
    return inertia_of(points);
  }

 private:
  std::mt19937 generator_;
};

std::string words(const Vector3d& v) {
  return format_shortest(v[0]) + " " + format_shortest(v[1]) + " " + format_shortest(v[2]);
}

// By the C library and Eigen, not by the reader's own code.
Isometry3d pose(const Vector3d& xyz, const Vector3d& rpy) {
  Isometry3d X = Isometry3d::Identity();
  X.translate(xyz);
  X.rotate(Eigen::AngleAxisd(rpy[2], Vector3d::UnitZ()));
  X.rotate(Eigen::AngleAxisd(rpy[1], Vector3d::UnitY()));
  X.rotate(Eigen::AngleAxisd(rpy[0], Vector3d::UnitX()));
  return X;
}

// A tree of links welded to one moving link, as text, and the same as a heap of point masses in the moving
// link.
struct Welded {
  std::string text;
  std::vector<PointMass> points;
};

Welded welded_tree(unsigned seed, int links) {
  RandomParts random(seed);
  Welded tree;
  tree.text = link_text("base");
  std::vector<Isometry3d> X;
  for (int i = 0; i < links; ++i) {
    const std::string name = "part" + std::to_string(i);
    const Vector3d xyz = random.vector(0.5), rpy = random.vector(3), inertial_rpy = random.vector(3);
    const std::string origin = "<origin xyz='" + words(xyz) + "' rpy='" + words(rpy) + "'/>";
    if (i == 0) {
      X.push_back(Isometry3d::Identity());
      tree.text += joint_text("swing", "continuous", "base", name, "0 0 1", origin);
    } else {
      const int parent = random.below(i);
      X.push_back(X[std::size_t(parent)] * pose(xyz, rpy));
      tree.text += joint_text("weld" + std::to_string(i), "fixed", "part" + std::to_string(parent), name,
                              "1 0 0", origin);
    }
    if (i % 4 == 3) {  // some parts weigh nothing
      tree.text += link_text(name);
      continue;
    }
    const Inertia body = random.inertia();
    const Matrix3d& I = body.about_com;
    tree.text +=
        link_text(name, "<inertial><origin xyz='" + words(body.com) + "' rpy='" + words(inertial_rpy) +
                            "'/><mass value='" + format_shortest(body.mass) + "'/><inertia ixx='" +
                            format_shortest(I(0, 0)) + "' ixy='" + format_shortest(I(0, 1)) + "' ixz='" +
                            format_shortest(I(0, 2)) + "' iyy='" + format_shortest(I(1, 1)) + "' iyz='" +
                            format_shortest(I(1, 2)) + "' izz='" + format_shortest(I(2, 2)) + "'/></inertial>");
    Inertia in_its_frame = body;
    in_its_frame.com.setZero();
    add_points(in_its_frame, X.back() * pose(body.com, inertial_rpy), tree.points);
  }
  return tree;
}

// Some 10 kg within 3 m: inertias of some 100 kg m^2, a dozen roundings deep.
constexpr double kRoundOff = 1e-12;

TEST(Reduce, LumpingKeepsMassCentreAndInertia) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Welded tree = welded_tree(seed, 12);
    const Chain chain = chain_from(robot_text(tree.text));
    ASSERT_EQ(chain.bodies.size(), 2u);
    EXPECT_LE(largest_difference(chain.bodies[1].inertia, inertia_of(tree.points)), kRoundOff)
        << "seed " << seed;
  }
}

TEST(Reduce, TheCheckAboveSeesAGramAMillimetreAndADegree) {
  const Welded tree = welded_tree(1, 12);
  const Inertia lumped_body = chain_from(robot_text(tree.text)).bodies[1].inertia;
  Welded heavier = tree;
  heavier.points[0].mass += 1e-3;
  EXPECT_GT(largest_difference(lumped_body, inertia_of(heavier.points)), 1e-4);
  Welded shifted = tree;
  shifted.points[0].at[1] += 1e-3;
  EXPECT_GT(largest_difference(lumped_body, inertia_of(shifted.points)), 1e-5);
  Welded turned = tree;
  const Isometry3d degree = pose({0, 0, 0}, {0, 0, M_PI / 180});
  for (std::size_t i = 0; i < 6; ++i) turned.points[i].at = degree * turned.points[i].at;
  EXPECT_GT(largest_difference(lumped_body, inertia_of(turned.points)), 1e-4);
}

TEST(Reduce, WhatIsWeldedToTheWorldLoadsNothingThatMoves) {
  const Chain chain = chain_from(
      robot_text(link_text("base", inertial_text(5)) + link_text("plate", inertial_text(7)) +
                 joint_text("weld", "fixed", "base", "plate") + moving("arm", "continuous", "plate")));
  EXPECT_EQ(chain.bodies[0].inertia.mass, 5 + 7) << "the ground bears it";
  EXPECT_EQ(chain.bodies[1].inertia.mass, 1);
}

TEST(Reduce, JointsBehindWeldedLinksSitWhereTheLinksAre) {
  const std::string up = "<origin xyz='0 0 2'/>";
  const Chain chain =
      chain_from(robot_text(link_text("base") + moving("arm", "continuous", "base") + link_text("rod") +
                            joint_text("weld", "fixed", "arm", "rod", "1 0 0", up) +
                            moving("hand", "continuous", "rod", "0 0 1", "<origin xyz='1 0 0'/>")));
  EXPECT_EQ(chain.bodies[2].parent, 1);
  EXPECT_EQ(chain.bodies[2].joint.X_PJ.translation(), Vector3d(1, 0, 2));
  EXPECT_EQ(chain.frames[std::size_t(find_frame(chain, "rod"))].body, 1);
}

TEST(Reduce, InPlaneAxesAreRightHandedForEveryNormal) {
  EXPECT_EQ(in_plane_axes({0, 0, 1}).first, Vector3d(1, 0, 0));
  EXPECT_EQ(in_plane_axes({1, 0, 0}).first, Vector3d(0, 1, 0));
  EXPECT_EQ(in_plane_axes({0, 1, 0}).first, Vector3d(0, 0, 1));
  RandomParts random(3);
  for (int i = 0; i < 100; ++i) {
    const Vector3d normal = random.vector(1).normalized();
    const auto [x, y] = in_plane_axes(normal);
    EXPECT_LE((x.cross(y) - normal).norm(), 1e-15);  // three roundings
    EXPECT_LE(std::fabs(x.dot(normal)), 1e-15);
  }
}

}  // namespace
}  // namespace chainreel
