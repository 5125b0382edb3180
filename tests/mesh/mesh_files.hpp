// Mesh files made by tests, and what is known of the shapes in them.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/triangle_mesh.hpp"
#include "mesh/mesh_extents.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {

// A folder of its own for a test, gone with it.
class MeshFolder : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

// As long as it lives, the test and its children have no more than `more` bytes of address space beyond what is used.
class LessMemory {
 public:
  explicit LessMemory(std::size_t more) {
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit less = before_;
    less.rlim_cur = rlim_t(pages) * rlim_t(sysconf(_SC_PAGESIZE)) + rlim_t(more);
    setrlimit(RLIMIT_AS, &less);
  }
  ~LessMemory() { setrlimit(RLIMIT_AS, &before_); }
  LessMemory(const LessMemory&) = delete;
  LessMemory& operator=(const LessMemory&) = delete;

 private:
  rlimit before_{};
};

using Triangle = std::array<Eigen::Vector3d, 3>;

// The box from `lower` to `upper`, counter-clockwise from outside.
inline std::vector<Triangle> box_triangles(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  std::vector<Triangle> triangles;
  const auto corner = [&](int bits) {
    return Eigen::Vector3d((bits & 1 ? upper : lower)[0], (bits & 2 ? upper : lower)[1],
                           (bits & 4 ? upper : lower)[2]);
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return triangles;
}

inline std::string binary_stl(const std::vector<Triangle>& triangles, const std::string& head = "",
                              std::uint16_t attribute = 0) {
  std::string text = head;
  text.resize(80, ' ');
  const auto append = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  append(std::uint32_t(triangles.size()));
  for (const Triangle& triangle : triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);  // many exporters leave the normal out
    for (const Eigen::Vector3d& p : triangle)
      for (int i = 0; i < 3; ++i) append(float(p[i]));
    append(attribute);
  }
  return text;
}

inline std::string numbers(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text << p[0] << ' ' << p[1] << ' ' << p[2];
  return text.str();
}

inline std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid s\n";
  for (const Triangle& t : triangles)
    text += "facet normal 0 0 0\nouter loop\nvertex " + numbers(t[0]) + "\nvertex " + numbers(t[1]) +
            "\nvertex " + numbers(t[2]) + "\nendloop\nendfacet\n";
  return text + "endsolid s\n";
}

inline std::string obj(const std::vector<Triangle>& triangles, const std::string& head = "") {
  std::string text = head;
  for (const Triangle& t : triangles)
    text += "v " + numbers(t[0]) + "\nv " + numbers(t[1]) + "\nv " + numbers(t[2]) + "\nf -3 -2 -1\n";
  return text;
}

// What a Collada file says beside its triangles.
struct Collada {
  std::string meter = "1";
  std::string up = "Z_UP";
  std::string open = "<node id=\"n\">";  // the nodes around the mesh
  std::string close = "</node>";
  std::string effect = "<diffuse><color>0.2 0.4 0.6 1</color></diffuse>";
  std::string images;         // <library_images>
  std::string params;         // <newparam>s of the effect
  int count_more = 0;         // of triangles in `count`
  std::string instead_of_p;   // indices, where they are not 0 1 2 ..
  std::string normals;        // one a corner
  std::string vertex_colors;  // four numbers a corner
};

inline std::string collada_source(const std::string& id, const std::string& values, std::size_t count,
                                  const std::vector<std::string>& names) {
  std::string text = "<source id=\"" + id + "\"><float_array id=\"" + id + "a\" count=\"" +
                     std::to_string(names.size() * count) + "\">" + values +
                     "</float_array><technique_common><accessor source=\"#" + id + "a\" count=\"" +
                     std::to_string(count) + "\" stride=\"" + std::to_string(names.size()) + "\">";
  for (const std::string& name : names) text += "<param name=\"" + name + "\" type=\"float\"/>";
  return text + "</accessor></technique_common></source>\n";
}

inline std::string collada(const std::vector<Triangle>& triangles, const Collada& with = {}) {
  std::string positions, indices;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      positions += numbers(triangles[i][c]) + " ";
      indices += std::to_string(3 * i + c) + " ";
    }
  const std::size_t corners = 3 * triangles.size();
  std::string inputs = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
  std::string sources = collada_source("p", positions, corners, {"X", "Y", "Z"});
  if (!with.normals.empty()) {
    sources += collada_source("n", with.normals, corners, {"X", "Y", "Z"});
    inputs += "<input semantic=\"NORMAL\" source=\"#n\" offset=\"0\"/>";
  }
  if (!with.vertex_colors.empty()) {
    sources += collada_source("c", with.vertex_colors, corners, {"R", "G", "B", "A"});
    inputs += "<input semantic=\"COLOR\" source=\"#c\" offset=\"0\"/>";
  }
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset><unit name=\"u\" meter=\"" +
         with.meter + "\"/><up_axis>" + with.up + "</up_axis></asset>\n" + with.images +
         "<library_effects><effect id=\"e\"><profile_COMMON>" + with.params + "<technique sid=\"t\"><phong>" +
         with.effect +
         "</phong></technique></profile_COMMON></effect></library_effects>\n"
         "<library_materials><material id=\"m\" name=\"m\"><instance_effect url=\"#e\"/></material>"
         "</library_materials>\n<library_geometries><geometry id=\"g\"><mesh>" +
         sources +
         "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"" +
         std::to_string(int(triangles.size()) + with.count_more) + "\" material=\"s\">" + inputs + "<p>" +
         (with.instead_of_p.empty() ? indices : with.instead_of_p) +
         "</p></triangles></mesh></geometry></library_geometries>\n"
         "<library_visual_scenes><visual_scene id=\"vs\">" +
         with.open +
         "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" "
         "target=\"#m\"/></technique_common></bind_material></instance_geometry>" +
         with.close +
         "</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url=\"#vs\"/></scene>"
         "</COLLADA>\n";
}

inline Eigen::Vector3d point_of(const std::array<float, 3>& p) {
  return {double(p[0]), double(p[1]), double(p[2])};
}

inline Box box_of(const TriangleMesh& mesh) {
  Box box;
  for (const TriangleMesh::Vertex& vertex : mesh.vertices) box.add(point_of(vertex.position));
  return box;
}

// By the divergence theorem: a sixth of the sum of a . (b x c). Positive where triangles run
// counter-clockwise seen from outside; a hole or a turned triangle changes it.
inline double volume_of(const TriangleMesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const auto p = [&](std::size_t c) { return point_of(mesh.vertices[mesh.triangles[i + c]].position); };
    six += p(0).dot(p(1).cross(p(2)));
  }
  return six / 6;
}

// Sum of the triangles' vector areas: zero where nothing is open.
inline Eigen::Vector3d vector_area_of(const TriangleMesh& mesh) {
  Eigen::Vector3d twice(0, 0, 0);
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const auto p = [&](std::size_t c) { return point_of(mesh.vertices[mesh.triangles[i + c]].position); };
    twice += (p(1) - p(0)).cross(p(2) - p(0));
  }
  return 0.5 * twice;
}

// Unit normals on the side that the order of the corners calls outside.
inline void expect_sound_normals(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const auto p = [&](std::size_t c) { return point_of(mesh.vertices[mesh.triangles[i + c]].position); };
    const Eigen::Vector3d face = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Vector3d n = point_of(mesh.vertices[mesh.triangles[i + c]].normal);
      ASSERT_NEAR(n.norm(), 1, 1e-6) << "triangle " << i / 3;  // single precision
      ASSERT_GT(n.dot(face), 0.7) << "triangle " << i / 3;     // smoothing turns by less than 45 degrees
    }
  }
}

inline std::set<std::array<std::uint8_t, 4>> colors_of(const TriangleMesh& mesh) {
  std::set<std::array<std::uint8_t, 4>> colors;
  for (const auto& vertex : mesh.vertices) colors.insert(vertex.color);
  return colors;
}

}  // namespace chainreel
