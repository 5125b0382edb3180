#include "draw/chain.hpp"

#include <algorithm>
#include <cmath>

#include "draw/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

// Shapes that are sorted as one: a link, or a joint with all its parts.
struct Part {
  double depth = 0;
  Picture shapes;
};

// Places this far from the page would only overflow in the renderer, in units of H.
constexpr double kOffPage = 100;

bool is_drawable(Point p) {
  return std::abs(p.x) < kOffPage && std::abs(p.y) < kOffPage;  // false for NaN, too
}

// The root link's origin, where what is fixed to the world begins.
Vector3d root_place(const Chain& chain) {
  if (chain.frames.empty() || chain.frames[0].body != 0) return Vector3d::Zero();
  return chain.frames[0].X_BF.translation();
}

bool carries_rail(const Chain& chain, int body) {
  return std::any_of(chain.bodies.begin() + 1, chain.bodies.end(), [&](const Body& child) {
    return child.parent == body && child.joint.kind == JointKind::prismatic;
  });
}

Color link_color(const ChainDrawing& drawing, int body) {
  const int index = drawing.skeleton.color[std::size_t(body)];
  return drawing.look.theme->link[std::size_t(std::max(index, 0)) % drawing.look.theme->link.size()];
}

PageLine rail_on_page(const ChainDrawing& drawing, const Workspace& ws, const Rail& rail) {
  return {drawing.camera.project(rail_point(drawing.chain, ws, rail.body, rail.lower)),
          drawing.camera.project(rail_point(drawing.chain, ws, rail.body, rail.upper))};
}

// Which way the rail runs on the page, also where it has no length.
Point rail_direction(const ChainDrawing& drawing, const Workspace& ws, int body) {
  const Joint& joint = drawing.chain.bodies[std::size_t(body)].joint;
  const int parent = drawing.chain.bodies[std::size_t(body)].parent;
  const Vector3d axis = pose_of(ws, parent).linear() * (joint.X_PJ.linear() * joint.axis);
  return unit(drawing.camera.project_vector(axis));
}

// A rail without length gets one that only says which way it runs.
PageLine with_direction(PageLine way, Point direction) {
  constexpr double kSpeck = 1e-6;
  if (std::hypot(way.b.x - way.a.x, way.b.y - way.a.y) > kSpeck) return way;
  return {way.a - kSpeck * direction, way.b + kSpeck * direction};
}

void draw_rail_of(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const Rail& rail,
                  int clip) {
  const PageLine way =
      with_direction(rail_on_page(drawing, ws, rail), rail_direction(drawing, ws, rail.body));
  if (!is_drawable(way.a) || !is_drawable(way.b)) return;
  const int parent = drawing.chain.bodies[std::size_t(rail.body)].parent;
  if (parent == 0) {
    draw_rail_ground(picture, way, drawing.look, clip);
    draw_rail(picture, way, tinted(drawing.look.theme->base, 0.25, drawing.look), drawing.look, clip);
  } else {
    draw_rail(picture, way, tinted(link_color(drawing, parent), 0.4, drawing.look), drawing.look, clip);
  }
}

void draw_link(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const LinkSegment& link,
               int clip) {
  const Eigen::Isometry3d X_WB = pose_of(ws, link.body);
  const Point a = drawing.camera.project(X_WB * link.from), b = drawing.camera.project(X_WB * link.to);
  if (!is_drawable(a) || !is_drawable(b)) return;
  const ChainLook& look = drawing.look;
  const Color fill = toned(link_color(drawing, link.body), look), ink = toned(look.theme->ink, look);
  picture.add(Capsule{a, b, look.link_width / 2, {fill, ink, size::kLinkOutline}}, clip);
  if (drawing.skeleton.color[std::size_t(link.body)] < int(look.theme->link.size())) return;
  // From the fifth link on the colours repeat: a hatch tells them apart.
  const Point along = unit(b - a);
  const Point stroke = (0.36 * look.link_width) * (along + normal_to(along));
  const double length = std::hypot(b.x - a.x, b.y - a.y), spacing = size::kGroundSpacing;
  for (double s = spacing; s < length - spacing / 2; s += spacing) {
    const Point middle = a + s * along;
    draw_line(picture, {middle - stroke, middle + stroke}, size::kGroundHatch, ink, clip);
  }
}

// The joint by which a body hangs on its parent.
void draw_joint(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int body, int clip) {
  const Joint& joint = drawing.chain.bodies[std::size_t(body)].joint;
  const Point center = drawing.camera.project(pose_of(ws, body).translation());
  if (!is_drawable(center) || joint.kind == JointKind::floating) return;
  if (joint.kind == JointKind::revolute) {
    draw_revolute(picture, center, drawing.look, clip);
  } else {
    draw_carriage(picture, center, rail_direction(drawing, ws, body), carries_rail(drawing.chain, body),
                  toned(link_color(drawing, body), drawing.look), drawing.look, clip);
  }
}

// What is fixed between the root link and a joint, and the ground mark.
void draw_foot(Picture& picture, const ChainDrawing& drawing, const Body& body, int clip) {
  const Vector3d root = root_place(drawing.chain), place = body.joint.X_PJ.translation();
  const Point foot = drawing.camera.project(root), joint = drawing.camera.project(place);
  const ChainLook& look = drawing.look;
  if ((place - root).norm() <= 1e-3 * drawing.skeleton.reach) {
    if (body.joint.kind == JointKind::revolute) draw_pin(picture, joint, look, clip);
    return;
  }
  const double half = size::kGroundLength / 2;
  draw_ground(picture, {{foot.x - half, foot.y}, {foot.x + half, foot.y}}, {0, -1}, look, clip);
  picture.add(Capsule{foot,
                      joint,
                      look.link_width / 2,
                      {toned(look.theme->base, look), toned(look.theme->ink, look), size::kLinkOutline}},
              clip);
}

}  // namespace

void draw_base(Picture& picture, const ChainDrawing& drawing, int clip) {
  const Workspace at_rest(drawing.chain);  // rails fixed to the world do not ask for a pose
  for (const Body& body : drawing.chain.bodies) {
    if (&body == &drawing.chain.bodies[0] || body.parent != 0) continue;
    if (body.joint.kind != JointKind::floating) draw_foot(picture, drawing, body, clip);
  }
  for (const Rail& rail : drawing.skeleton.rails) {
    if (drawing.chain.bodies[std::size_t(rail.body)].parent == 0) {
      draw_rail_of(picture, drawing, at_rest, rail, clip);
    }
  }
}

void draw_links(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip) {
  std::vector<Part> parts;
  const auto part_at = [&](double depth) -> Picture& {
    parts.push_back({depth, {}});
    return parts.back().shapes;
  };
  // A line is as far as its farther end, so that the joint where it begins or ends lies above it.
  const auto depth_of = [&](const Vector3d& a, const Vector3d& b) {
    return std::min(drawing.camera.depth(a), drawing.camera.depth(b));
  };
  std::size_t link = 0;
  for (int b = 1; b < int(drawing.chain.bodies.size()); ++b) {
    const Vector3d origin = pose_of(ws, b).translation();
    for (const Rail& rail : drawing.skeleton.rails) {
      if (rail.body != b || drawing.chain.bodies[std::size_t(b)].parent == 0) continue;
      const double depth = depth_of(rail_point(drawing.chain, ws, b, rail.lower),
                                    rail_point(drawing.chain, ws, b, rail.upper));
      draw_rail_of(part_at(depth), drawing, ws, rail, clip);
    }
    for (; link < drawing.skeleton.links.size() && drawing.skeleton.links[link].body == b; ++link) {
      const LinkSegment& segment = drawing.skeleton.links[link];
      const double depth = depth_of(pose_of(ws, b) * segment.from, pose_of(ws, b) * segment.to);
      draw_link(part_at(depth), drawing, ws, segment, clip);
    }
    draw_joint(part_at(drawing.camera.depth(origin)), drawing, ws, b, clip);
  }
  if (!drawing.chain.planar) {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.depth < b.depth; });
  }
  for (Part& part : parts) {
    std::move(part.shapes.items.begin(), part.shapes.items.end(), std::back_inserter(picture.items));
  }
}

Vector3d tip_position(const Chain& chain, const Workspace& ws) {
  return frame_position(chain, ws, chain.end_effector);
}

ChainFit::ChainFit(const Chain& chain, const Skeleton& skeleton, const Camera& camera)
    : chain_(chain), skeleton_(skeleton), camera_(camera) {
  const double outline = size::kLinkOutline / 2;
  Room link = room_around(size::kLinkWidth / 2 + outline);
  link.metres = kLinkWidthOfShortest * skeleton.shortest_link / 2;
  link.beyond = outline;
  link_ = box_.add_kind(link);
  joint_ = box_.add_kind(room_around((size::kJointDisc + size::kJointOutline) / 2));
  // A rail may run any way: its end's farthest corner.
  rail_ =
      box_.add_kind(room_around(std::max(std::hypot(kRailOverhang, size::kRailGap / 2), kCarrierLength / 2)));
  tip_ = box_.add_kind(room_around(size::kEndEffector / 2));
  add_base();
}

void ChainFit::add_to(int kind, const Vector3d& place) {
  box_.add(kind, {camera_.right.dot(place), camera_.up.dot(place)});
}

void ChainFit::add(const Vector3d& place, const Room& room) {
  add_to(box_.add_kind(room), place);
}

void ChainFit::add_base() {
  const double half = (size::kGroundLength + size::kGroundLine) / 2;  // its ends are round
  for (std::size_t b = 1; b < chain_.bodies.size(); ++b) {
    const Joint& joint = chain_.bodies[b].joint;
    if (chain_.bodies[b].parent != 0 || joint.kind == JointKind::floating) continue;
    const bool on_root = (joint.X_PJ.translation() - root_place(chain_)).norm() <= 1e-3 * skeleton_.reach;
    if (!on_root || joint.kind == JointKind::revolute) {
      add(on_root ? joint.X_PJ.translation() : root_place(chain_), {half, half, pin_depth(), 0});
    }
  }
  const Workspace at_rest(chain_);
  for (const Rail& rail : skeleton_.rails) {
    if (chain_.bodies[std::size_t(rail.body)].parent != 0) continue;
    for (const double value : {rail.lower, rail.upper}) {
      add(rail_point(chain_, at_rest, rail.body, value),
          room_around(std::hypot(kRailOverhang, rail_ground_depth())));
    }
  }
}

void ChainFit::add_pose(const Workspace& ws, double limit) {
  const auto is_wild = [&](int body) { return !(pose_of(ws, body).translation().norm() <= limit); };
  for (int b = 1; b < int(chain_.bodies.size()); ++b) {
    if (is_wild(b)) return;
  }
  for (const LinkSegment& link : skeleton_.links) {
    add_to(link_, pose_of(ws, link.body) * link.from);
    add_to(link_, pose_of(ws, link.body) * link.to);
  }
  for (int b = 1; b < int(chain_.bodies.size()); ++b) {
    if (chain_.bodies[std::size_t(b)].joint.kind == JointKind::revolute)
      add_to(joint_, pose_of(ws, b).translation());
  }
  for (const Rail& rail : skeleton_.rails) {
    if (chain_.bodies[std::size_t(rail.body)].parent == 0) continue;
    add_to(rail_, rail_point(chain_, ws, rail.body, rail.lower));
    add_to(rail_, rail_point(chain_, ws, rail.body, rail.upper));
  }
  add_to(tip_, tip_position(chain_, ws));
}

}  // namespace chainreel
