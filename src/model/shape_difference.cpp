#include "model/shape_difference.hpp"

#include <algorithm>
#include <cmath>

#include "core/change_words.hpp"
#include "core/format.hpp"
#include "model/model_match.hpp"

namespace chainreel {
namespace {

constexpr double kSameTurn = 1e-14;  // rad: the round-off of sines of two writings
constexpr std::size_t kMostSearched =
    1000;  // shapes of a link; of more, each is compared with that of its place
constexpr const char* kNames[] = {"box", "cylinder", "sphere", "mesh"};

std::string rgba_text(const std::optional<std::array<std::uint8_t, 4>>& color) {
  if (!color) return "none";
  std::vector<std::string> words;
  for (const std::uint8_t channel : *color) words.push_back(std::to_string(channel));
  return joined(words, " ");
}

double turn_between(const UrdfOrigin& before, const UrdfOrigin& after) {
  // |R1 - R2| (Frobenius) is 2 sqrt(2) sin(angle / 2).
  const double chord = (isometry_of(before).linear() - isometry_of(after).linear()).norm();
  return 2 * std::asin(std::min(1.0, chord / std::sqrt(8.0)));
}

std::string triple_text(const Eigen::Vector3d& v) {
  return format_shortest(v.x()) + " " + format_shortest(v.y()) + " " + format_shortest(v.z());
}

std::string box_text(const TriangleSketch& sketch) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < 3; ++i)
    words.push_back(format_significant(double(sketch.upper[i]) - double(sketch.lower[i]), 4));
  return joined(words, " x ");
}

// How the box around a mesh changed; "" where it did not.
std::string box_words(const TriangleSketch& before, const TriangleSketch& after) {
  if (before.lower == after.lower && before.upper == after.upper) return "";
  Eigen::Vector3d grown, moved;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = double(after.lower[i]) - double(before.lower[i]),
                 high = double(after.upper[i]) - double(before.upper[i]);
    grown[int(i)] = high - low;
    moved[int(i)] = (high + low) / 2;
  }
  // Of floats.
  const bool is_grown =
      grown.norm() > 1e-6 * (moved.norm() + std::abs(double(after.upper[0]) - double(after.lower[0])));
  return is_grown ? "; the box around it " + change_text(box_text(before), box_text(after)) + " m"
                  : "; the box around it moved by " + length_text(moved.norm());
}

std::string triangles_words(const TriangleSketch& before, const TriangleSketch& after) {
  const TriangleDifference difference = difference_of(before, after);
  const std::string all =
      " of its " + std::to_string(std::max(before.triangles, after.triangles)) + " triangles";
  const auto count = [](double number) { return std::to_string(long(std::lround(number))); };
  if (difference.gone == 0 && difference.come == 0)
    return before.colors != after.colors
               ? "the same triangles in other colours"
               : "the same triangles with other normals, which are shaded otherwise";
  if (difference.share > 0.9999) return "all" + all + " differ" + box_words(before, after);
  if (difference.is_counted && difference.come == 0)
    return count(difference.gone) + all + " gone" + box_words(before, after);
  if (difference.is_counted && difference.gone == 0)
    return count(difference.come) + all + " added" + box_words(before, after);
  const std::string share = format_significant(100 * difference.share, 2) + " %" + all + " differ";
  return (difference.is_counted ? share : "about " + share) + box_words(before, after);
}

class Shapes {
 public:
  Shapes(const ShapesOfLink& before, const ShapesOfLink& after, std::string link, std::string what,
         ToldMeshes& told)
      : before_(before), after_(after), link_(std::move(link)), what_(std::move(what)), told_(told) {}

  std::vector<ShapeDifference> run() {
    std::vector<std::size_t> gone, come;
    std::vector<int> partners;  // of those of `after`
    pair(gone, come, partners);
    for (std::size_t i = 0; i < std::min(gone.size(), come.size()); ++i) compare(gone[i], come[i]);
    for (std::size_t i = come.size(); i < gone.size(); ++i) tell(gone[i], before_.shapes[gone[i]], "gone", 0);
    for (std::size_t i = gone.size(); i < come.size(); ++i)
      tell(come[i], after_.shapes[come[i]], "added", after_.shapes[come[i]].shape.line);
    if (gone.empty() && come.empty() && !std::is_sorted(partners.begin(), partners.end()))
      found_.push_back({"link " + link_ + ": its " + what_ + "s stand in another order",
                        after_.shapes.front().shape.line});
    return std::move(found_);
  }

 private:
  void pair(std::vector<std::size_t>& gone, std::vector<std::size_t>& come,
            std::vector<int>& partners) const {
    std::vector<bool> is_taken(before_.shapes.size(), false);
    const auto same = [&](std::size_t i, std::size_t k) {
      return !is_taken[i] && is_same(before_.shapes[i], before_.model, after_.shapes[k], after_.model);
    };
    for (std::size_t k = 0; k < after_.shapes.size(); ++k) {
      std::size_t i = k;  // most are where they were
      const std::size_t searched = before_.shapes.size() <= kMostSearched ? 0 : before_.shapes.size();
      if (i >= before_.shapes.size() || !same(i, k))
        for (i = searched; i < before_.shapes.size() && !same(i, k);) ++i;
      if (i == before_.shapes.size()) {
        come.push_back(k);
        continue;
      }
      is_taken[i] = true;
      partners.push_back(int(i));
    }
    for (std::size_t i = 0; i < before_.shapes.size(); ++i)
      if (!is_taken[i]) gone.push_back(i);
  }

  void tell(std::size_t index, const DescribedShape& shape, const std::string& words, int line) {
    const std::string name = shape.shape.kind == UrdfShapeKind::mesh
                                 ? "mesh " + shape.shape.mesh_file
                                 : std::string(kNames[std::size_t(shape.shape.kind)]);
    found_.push_back(
        {"link " + link_ + ": " + what_ + " " + std::to_string(index + 1) + " (" + name + ") " + words,
         line});
  }

  void compare(std::size_t i, std::size_t k) {
    const DescribedShape &old = before_.shapes[i], &now = after_.shapes[k];
    const auto changed = [&](const std::string& words) { tell(k, now, words, now.shape.line); };
    if (old.shape.kind != now.shape.kind)
      changed("was a " + std::string(kNames[std::size_t(old.shape.kind)]));
    else if (now.shape.kind == UrdfShapeKind::mesh)
      compare_meshes(k, old, now);
    else if (old.shape.size != now.shape.size)
      changed(size_words(old.shape, now.shape));
    for (const std::string& words : origin_changes(old.shape.origin, now.shape.origin)) changed(words);
    if (old.color != now.color)
      changed("colour " + change_text(rgba_text(old.color), rgba_text(now.color)) + " of 255" +
              because(old, now));
  }

  static std::string size_words(const UrdfShape& old, const UrdfShape& now) {
    std::vector<std::string> words;
    const auto add = [&](const char* what, int i) {
      if (old.size[i] != now.size[i])
        words.push_back(what + (" " + change_text(old.size[i], now.size[i], "m")));
    };
    if (now.kind == UrdfShapeKind::box)
      return "size " + change_text(triple_text(old.size), triple_text(now.size)) + " m";
    add("radius", 0);
    if (now.kind == UrdfShapeKind::cylinder) add("length", 2);
    return joined(words);
  }

  void compare_meshes(std::size_t k, const DescribedShape& old, const DescribedShape& now) {
    if (old.shape.mesh_scale != now.shape.mesh_scale)
      tell(k, now,
           "scale " + change_text(triple_text(old.shape.mesh_scale), triple_text(now.shape.mesh_scale)),
           now.shape.line);
    const DescribedMesh &before = before_.model.meshes[std::size_t(old.mesh)],
                        &after = after_.model.meshes[std::size_t(now.mesh)];
    if (is_same(before, after)) return;
    if (before.file != after.file) tell(k, now, "was mesh " + before.file, now.shape.line);
    if (!told_.insert({old.mesh, now.mesh}).second) return;
    const std::string mesh = "mesh " + after.file + " (" + links_of(now.mesh) + "): ";
    if (!before.sketch || !after.sketch) {
      if (before.sketch || after.sketch)
        found_.push_back(
            {mesh + (after.sketch ? "can be read now" : "cannot be read any more"), now.shape.line});
      return;
    }
    found_.push_back({mesh + triangles_words(*before.sketch, *after.sketch), now.shape.line});
  }

  // Who shows a mesh: what changed in it is told once, of all of them.
  std::string links_of(int mesh) const {
    std::vector<std::string> names;
    for (const DescribedLink& link : after_.model.links) {
      const auto shows = [&](const std::vector<DescribedShape>& shapes) {
        return std::any_of(shapes.begin(), shapes.end(),
                           [&](const DescribedShape& shape) { return shape.mesh == mesh; });
      };
      if (shows(link.visuals) || shows(link.collisions)) names.push_back(link.name);
    }
    return (names.size() == 1 ? "link " : "links ") + shortened(joined(names), 200);
  }

  static std::string because(const DescribedShape& old, const DescribedShape& now) {
    const auto source = [](const DescribedShape& shape) {
      return !shape.texture.empty()   ? "texture " + shape.texture
             : shape.material.empty() ? ""
                                      : "material " + shape.material;
    };
    if (source(old) == source(now)) return source(now).empty() ? "" : " (" + source(now) + ")";
    const auto named = [](const std::string& text) { return text.empty() ? "none" : text; };
    return " (" + change_text(named(source(old)), named(source(now))) + ")";
  }

  const ShapesOfLink &before_, &after_;
  std::string link_, what_;
  ToldMeshes& told_;
  std::vector<ShapeDifference> found_;
};

}  // namespace

std::string move_words(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  std::vector<std::string> parts;
  for (int i = 0; i < 3; ++i)
    if (before[i] != after[i])
      parts.push_back(std::string(1, "xyz"[i]) + " " + change_text(before[i], after[i], "m"));
  return "moved by " + length_text((after - before).norm()) + " (" + joined(parts) + ")";
}

std::string turn_words(const UrdfOrigin& before, const UrdfOrigin& after) {
  if (before.rpy == after.rpy) return "";
  const double angle = turn_between(before, after);
  if (angle < kSameTurn) return "";
  return "turned by " + angle_text(angle) + " (rpy " +
         change_text(triple_text(before.rpy), triple_text(after.rpy)) + ")";
}

std::vector<std::string> origin_changes(const UrdfOrigin& before, const UrdfOrigin& after) {
  std::vector<std::string> changes;
  if (before.xyz != after.xyz) changes.push_back(move_words(before.xyz, after.xyz));
  if (const std::string turn = turn_words(before, after); !turn.empty()) changes.push_back(turn);
  return changes;
}

std::vector<ShapeDifference> shape_differences(const ShapesOfLink& before, const ShapesOfLink& after,
                                               const std::string& link, const std::string& what,
                                               ToldMeshes& told) {
  return Shapes(before, after, link, what, told).run();
}

}  // namespace chainreel
