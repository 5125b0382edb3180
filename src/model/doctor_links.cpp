// The doctor's look at links: masses, inertias, shapes, and how they fit together.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/format.hpp"
#include "mesh/mesh_extents.hpp"
#include "model/doctor.hpp"
#include "model/package_path.hpp"
#include "model/principal_moments.hpp"

namespace chainreel {
namespace {

using Severity = Finding::Severity;

constexpr double kHeaviestLink = 1e4;   // kg: more is likely grams
constexpr double kLargestShape = 100;   // m: more is likely millimetres
constexpr double kSmallestMesh = 1e-4;  // m: less is likely a scale applied twice

// The box around a shape in the link's frame, given the box in its own.
Box placed(const Box& box, const UrdfOrigin& origin, const Eigen::Vector3d& scale) {
  const Eigen::Isometry3d X = isometry_of(origin);
  Box result;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = scale[k] * ((corner >> k & 1) != 0 ? box.upper[k] : box.lower[k]);
    result.add(X * p);
  }
  return result;
}

Box around_origin(const Eigen::Vector3d& half) {
  Box box;
  box.add(half);
  box.add(-half);
  return box;
}

double distance(const Box& box, const Eigen::Vector3d& p) {
  return (box.lower - p).cwiseMax(p - box.upper).cwiseMax(0.0).norm();
}

std::string metres(double length) {
  return format_significant(length, 3) + " m";
}

class LinkExaminer {
 public:
  LinkExaminer(const UrdfFile& file, const ModelOptions& options, DoctorReport& report)
      : file_(file),
        report_(report),
        finder_(file.path, options.packages) {}

  void run() {
    for (const UrdfLink& link : file_.links) {
      Box box;
      for (const UrdfShape& shape : link.visuals) add_shape(link, shape, false, box);
      for (const UrdfShape& shape : link.collisions) add_shape(link, shape, true, box);
      if (link.inertial) examine_inertial(link, box);
    }
  }

 private:
  void add_shape(const UrdfLink& link, const UrdfShape& shape, bool is_collision, Box& box) {
    examine_angles(shape.origin, "a " + std::string(is_collision ? "<collision>" : "<visual>") + " of link '" +
                                     link.name + "'",
                   shape.line, report_);
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Box own;
    switch (shape.kind) {
      case UrdfShapeKind::box:
        own = around_origin(0.5 * shape.size);
        break;
      case UrdfShapeKind::cylinder:
        own = around_origin({shape.size[0], shape.size[1], 0.5 * shape.size[2]});
        break;
      case UrdfShapeKind::sphere:
        own = around_origin(shape.size);
        break;
      case UrdfShapeKind::mesh:
        own = mesh_box(link, shape, is_collision);
        scale = shape.mesh_scale;
        break;
    }
    if (own.is_empty()) return;
    const Box in_link = placed(own, shape.origin, scale);
    examine_size(link, shape, in_link.size().maxCoeff());
    box.add(in_link.lower);
    box.add(in_link.upper);
  }

  // Empty where there is no such mesh; that is reported. Only pictures that show it cannot do without.
  Box mesh_box(const UrdfLink& link, const UrdfShape& shape, bool is_collision) {
    const FoundFile& found = finder_.find(shape.mesh_file);
    if (found.path.empty()) {
      report_.add(Severity::warning,
                  is_collision ? "collision meshes that are not found" : "meshes that are not found", shape.line,
                  missing_mesh_message(link.name, shape.mesh_file, found));
      return {};
    }
    if (found.by_tail)
      report_.add(Severity::warning, "meshes that are found elsewhere", shape.line,
                  "link '" + link.name + "': the mesh '" + shape.mesh_file +
                      "' is not where its package should be, and is taken from " + found.path);
    const auto [known, is_new] = mesh_boxes_.emplace(found.path, Box{});
    if (is_new) {
      try {
        known->second = mesh_extents(found.path);
      } catch (const Error& error) {
        report_.add(Severity::warning, "meshes that cannot be read", shape.line,
                    "link '" + link.name + "': the mesh " + error.what());
      }
    }
    return known->second;
  }

  void examine_size(const UrdfLink& link, const UrdfShape& shape, double size) {
    const bool is_mesh = shape.kind == UrdfShapeKind::mesh;
    const std::string what =
        "link '" + link.name + "' has a " + (is_mesh ? "mesh" : "shape") + " of " + metres(size);
    if (size > kLargestShape) {
      report_.add(Severity::warning, "shapes that are very large", shape.line,
                  what + ": were millimetres meant? " +
                      (is_mesh ? "Write scale=\"0.001 0.001 0.001\"" : "URDF has metres"));
    } else if (is_mesh && size < kSmallestMesh) {
      report_.add(Severity::warning, "meshes that are very small", shape.line,
                  what + ": is its scale applied twice, in the file and in the URDF?");
    }
  }

  void examine_inertial(const UrdfLink& link, const Box& box) {
    const UrdfInertial& inertial = *link.inertial;
    const std::string owner = "link '" + link.name + "'";
    examine_angles(inertial.origin, "the <inertial> of " + owner, inertial.line, report_);
    if (inertial.mass > kHeaviestLink) {
      report_.add(Severity::warning, "links that are very heavy", inertial.line,
                  owner + " weighs " + format_significant(inertial.mass, 3) +
                      " kg: were grams meant? URDF has kilograms");
    }
    const Eigen::Vector3d moments = principal_moments(inertial.inertia);
    if (inertial.mass == 0 && moments.isZero(0)) return;
    examine_moments(owner, inertial, moments);
    if (!box.is_empty()) examine_fit(owner, inertial, moments, box);
  }

  void examine_moments(const std::string& owner, const UrdfInertial& inertial,
                       const Eigen::Vector3d& moments) {
    if (!is_positive(moments)) {
      // Where the body that it is a part of is not positive, either, read_chain refuses it as well.
      report_.add(
          Severity::warning, "inertias that are not positive", inertial.line,
          owner + " has an inertia that is not positive (principal moments " + moments_text(moments) + ")");
    } else if (!keeps_triangle_inequality(moments)) {
      report_.add(
          Severity::warning, "inertias that break the triangle inequality", inertial.line,
          owner + " has principal moments " + moments_text(moments) +
              ", and no body has one larger than the sum of the others: is it about the centre of mass, and "
              "are ixx and the others in the right order?");
    } else if (moments.isZero(0)) {
      report_.add(Severity::note, "point masses", inertial.line,
                  owner + " is a point mass: it has no inertia of its own");
    }
  }

  void examine_fit(const std::string& owner, const UrdfInertial& inertial, const Eigen::Vector3d& moments,
                   const Box& box) {
    const double diagonal = box.size().norm();
    const double away = distance(box, inertial.origin.xyz);
    if (away > diagonal) {
      report_.add(Severity::warning, "centres of mass far from their shapes", inertial.line,
                  owner + " has its centre of mass " + metres(away) + " outside its shapes, which measure " +
                      metres(diagonal) + " across: is its <origin> in metres and in the link's frame?");
    }
    if (inertial.mass <= 0) return;
    // A body inside the box has at most half its diagonal; twice as much allows for shapes that are only a
    // part.
    const double gyration = std::sqrt(std::max(moments[2], 0.0) / inertial.mass);
    if (gyration > diagonal) {
      report_.add(Severity::warning, "inertias too large for their shapes", inertial.line,
                  owner + " has a radius of gyration of " + metres(gyration) + ", and its shapes measure " +
                      metres(diagonal) + " across: is the inertia in kg m^2?");
    }
  }

  const UrdfFile& file_;
  DoctorReport& report_;
  FileFinder finder_;
  std::map<std::string, Box> mesh_boxes_;  // by path
};

}  // namespace

void examine_links(const UrdfFile& file, const ModelOptions& options, DoctorReport& report) {
  LinkExaminer(file, options, report).run();
}

}  // namespace chainreel
