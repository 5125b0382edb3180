#include "draw/robot/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "draw/robot/fit.hpp"
#include "draw/robot/joints.hpp"
#include "dynamics/kinematics.hpp"

namespace chainreel {
namespace {

using Eigen::Vector3d;

// Shapes that are sorted as one: a link, or a joint with all its parts.
struct Part {
  double depth = 0;
  Picture shapes;
};

constexpr double kBodyOutline = 0.0015;  // of body shapes, units of H: their light shows their form
constexpr double kBodyInk = 0.55;        // its opacity: a white body on a white page still ends where contrast is 3
// Opacity of the black of a shadow, on a white page and on a dark one.
constexpr double kShadow = 0.17, kShadowOnDark = 0.5;
constexpr double kContact = 0.22, kContactOnDark = 0.5;  // ... and where a body touches the ground, besides
constexpr double kNear = 0.12;           // of the longest reach: what stands higher has no contact
constexpr double kSoft = 0.030, kSoftContact = 0.014;  // units of H: how far their edges are blurred
constexpr double kShadowFades = 0.07;    // units of H before the edges of the scene

// Seen along the normal of the plane in which all motion stays.
bool is_face_on(const ChainDrawing& drawing) {
  if (!drawing.chain.planar) return false;
  return std::abs(drawing.camera.toward_viewer.dot(drawing.chain.planar->plane.normal)) > 1 - 1e-9;
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
  return unit(drawing.camera.project_vector(axis, pose_of(ws, body).translation()));
}

// A rail without length gets one that only says which way it runs.
PageLine with_direction(PageLine way, Point direction) {
  constexpr double kSpeck = 1e-6;
  if (norm(way.b - way.a) > kSpeck) return way;
  return {way.a - kSpeck * direction, way.b + kSpeck * direction};
}

void draw_rail_of(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const Rail& rail,
                  int clip) {
  const PageLine line = rail_line(drawing, ws, rail);
  if (!is_drawable(line.a) || !is_drawable(line.b)) return;
  const int parent = drawing.chain.bodies[std::size_t(rail.body)].parent;
  if (parent == 0) draw_rail_ground(picture, line, drawing.look, clip);
  const Color fill = parent == 0 ? tinted(drawing.look.theme->base, 0.25, drawing.look)
                                 : tinted(link_color(drawing, parent), 0.4, drawing.look);
  draw_rail(picture, line, drawing.look.filled ? fill : Color{}, drawing.look, clip);
}

void draw_carriage_of(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const Rail& rail,
                      int clip) {
  const Point center = drawing.camera.project(pose_of(ws, rail.body).translation());
  if (!is_drawable(center)) return;
  draw_carriage(picture, center, rail_direction(drawing, ws, rail.body), rail.carrier,
                filling(link_color(drawing, rail.body), drawing.look), drawing.look, clip);
}

void draw_link(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const LinkSegment& link,
               int clip) {
  const Eigen::Isometry3d X_WB = pose_of(ws, link.body);
  const Point a = drawing.camera.project(X_WB * link.from), b = drawing.camera.project(X_WB * link.to);
  if (!is_drawable(a) || !is_drawable(b)) return;
  const ChainLook& look = drawing.look;
  const Color fill = filling(link_color(drawing, link.body), look), ink = toned(look.theme->ink, look);
  picture.add(Capsule{a, b, look.link_width / 2, {fill, ink, look.stroke * size::kLinkOutline}}, clip);
  if (drawing.skeleton.color[std::size_t(link.body)] < int(look.theme->link.size()) || !look.filled) return;
  // From the fifth link on the colours repeat: a hatch tells them apart.
  const Point along = unit(b - a);
  const Point stroke = (0.36 * look.link_width) * (along + normal_to(along));
  const double length = norm(b - a), spacing = size::kGroundSpacing;
  for (double s = spacing; s < length - spacing / 2; s += spacing) {
    const Point middle = a + s * along;
    draw_line(picture, {middle - stroke, middle + stroke}, size::kGroundHatch, ink, clip);
  }
}

// Two pieces of one body that leave its joint in different directions are one rigid piece, as a coupler with a point beside its line is:
// a plate, where the motion is seen face-on.
bool are_plate(const ChainDrawing& drawing, const LinkSegment& one, const LinkSegment& other) {
  constexpr double kFlat = 0.05;  // sine of the angle between both: below it one lies along the other
  const Vector3d u = one.to - one.from, v = other.to - other.from;
  return is_face_on(drawing) && one.body == other.body && one.from == other.from && u.cross(v).norm() > kFlat * u.norm() * v.norm();
}

void draw_plate(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const LinkSegment& one, const LinkSegment& other, int clip) {
  const Eigen::Isometry3d X_WB = pose_of(ws, one.body);
  const std::array<Point, 3> corners{drawing.camera.project(X_WB * one.from), drawing.camera.project(X_WB * one.to),
                                     drawing.camera.project(X_WB * other.to)};
  if (!std::ranges::all_of(corners, is_drawable)) return;
  const ChainLook& look = drawing.look;
  const Color fill = filling(link_color(drawing, one.body), look), ink = toned(look.theme->ink, look);
  const double line = look.stroke * size::kLinkOutline, half = look.link_width / 2;
  constexpr double kInside = 0.3;
  picture.add(Polygon{{corners[0], corners[1], corners[2]}, 3, {fill.faded(kInside), look.filled ? Color{} : ink, line}}, clip);
  if (!look.filled) return;
  // Outlines first, so that none crosses where two sides meet.
  for (const auto& [color, radius] : {std::pair{ink, half + line / 2}, {fill, half - line / 2}})
    for (std::size_t i = 0; i < corners.size(); ++i)
      picture.add(Capsule{corners[i], corners[(i + 1) % corners.size()], radius, {color, {}, 0}}, clip);
}

// What is fixed between the root link and a joint, and the ground mark.
void draw_foot(Picture& picture, const ChainDrawing& drawing, const Body& body, int clip) {
  const Vector3d root = root_place(drawing.chain), place = body.joint.X_PJ.translation();
  const Point foot = drawing.camera.project(root), joint = drawing.camera.project(place);
  const ChainLook& look = drawing.look;
  if (hangs_on_root(drawing.chain, drawing.skeleton, body)) {
    if (body.joint.kind == JointKind::revolute) draw_pin(picture, joint, look, clip);
    return;
  }
  const Point side = (look.link_width / 2) * normal_to(unit(joint - foot));
  picture.add(
      Polygon{{foot + side, joint + side, joint - side, foot - side},
              4,
              {tinted(look.theme->base, 0.35, look), toned(look.theme->base, look), size::kLinkOutline}},
      clip);
  const Point half{look.marks * size::kGroundLength / 2, 0};
  draw_ground(picture, {foot - half, foot + half}, {0, -1}, look, clip);
}

// Of a body without extent, or a payload. Its size says nothing: a mass that changes a little leaves pictures as they are.
void draw_point_mass(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, const PointMass& point, int clip) {
  const Point center = drawing.camera.project(pose_of(ws, point.body) * point.at);
  const ChainLook& look = drawing.look;
  if (!is_drawable(center) || !look.filled) return;  // outlines have joints alone
  const double r = std::min(look.marks * kPointMass, kPointOfLink * look.link_width);
  const Color fill = toned(point.is_payload ? look.theme->muted : link_color(drawing, point.body), look);
  picture.add(Ellipse{center, {r, 0}, {0, r}, {fill, toned(look.theme->ink, look), look.stroke * size::kLinkOutline}}, clip);
}

void draw_bodies(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip) {
  Solids solids = solids_seen_by(drawing.camera);
  add_bodies(solids, *drawing.shapes, ws, drawing.camera);
  solids.opacity = drawing.look.strength;
  solids.outline = drawing.look.theme->ink.faded(kBodyInk);
  solids.outline_width = kBodyOutline;
  picture.add(std::move(solids), clip);
}

}  // namespace

PageLine rail_line(const ChainDrawing& drawing, const Workspace& ws, const Rail& rail) {
  const PageLine way = with_direction(rail_on_page(drawing, ws, rail), rail_direction(drawing, ws, rail.body));
  return with_overhang(way, rail.carrier, drawing.look);
}

void draw_shadow(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, double height, const Rect& area, int clip) {
  if (!drawing.shapes) return;
  const Vector3d up = up_of(drawing.chain);
  const bool on_dark = is_dark(*drawing.look.theme);
  Solids shadow = solids_seen_by(drawing.camera);
  shadow.is_shadow = true;
  shadow.fade = {area, kShadowFades, kShadowFades, kShadowFades, kShadowFades};
  Solids all = shadow;
  add_shadows(all, *drawing.shapes, ws, drawing.camera, up, height);
  all.outline = color_of(0x000000, drawing.look.strength * (on_dark ? kShadowOnDark : kShadow));
  all.outline_width = kSoft;
  const std::vector<Solid> parts = all.parts;
  picture.add(std::move(all), clip);
  const double highest = kNear * drawing.skeleton.reach;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const BodyShape& shape = drawing.shapes->shapes[i];
    double lowest = HUGE_VAL;
    for (const Vector3d& corner : shape.corners) lowest = std::min(lowest, std::abs(up.dot(pose_of(ws, shape.body) * corner) - height));
    if (!(lowest < highest)) continue;
    Solids contact = shadow;
    contact.parts = {parts[i]};
    contact.outline = color_of(0x000000, drawing.look.strength * (1 - lowest / highest) * (on_dark ? kContactOnDark : kContact));
    contact.outline_width = kSoftContact;
    picture.add(std::move(contact), clip);
  }
}

void draw_base(Picture& picture, const ChainDrawing& drawing, int clip) {
  if (drawing.shapes) return;
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

void draw_rails(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip) {
  if (drawing.shapes) return;
  for (const Rail& rail : drawing.skeleton.rails) {
    if (!drawing.shows(rail.body)) continue;
    if (drawing.chain.bodies[std::size_t(rail.body)].parent != 0)
      draw_rail_of(picture, drawing, ws, rail, clip);
    if (rail.carrier) draw_carriage_of(picture, drawing, ws, rail, clip);
  }
}

void draw_links(Picture& picture, const ChainDrawing& drawing, const Workspace& ws, int clip) {
  if (drawing.shapes) {
    draw_bodies(picture, drawing, ws, clip);
    // Those of bodies are among the shapes.
    for (const PointMass& point : drawing.chain.point_masses)
      if (point.is_payload) draw_point_mass(picture, drawing, ws, point, clip);
    return;
  }
  const std::vector<LinkSegment>& links = drawing.skeleton.links;
  const std::vector<Rail>& rails = drawing.skeleton.rails;
  std::vector<Part> parts;
  const auto part_at = [&](double depth) -> Picture& {
    parts.push_back({depth, {}});
    return parts.back().shapes;
  };
  std::size_t link = 0, rail = 0;
  for (int b = 1; b < int(drawing.chain.bodies.size()); ++b) {
    const auto behind = std::size_t(std::find_if(links.begin() + std::ptrdiff_t(link), links.end(), [b](const LinkSegment& one) { return one.body != b; }) - links.begin());
    const bool has_rail = rail < rails.size() && rails[rail].body == b;
    if (!drawing.shows(b)) {
      link = behind;
      rail += has_rail;
      continue;
    }
    if (behind == link + 2 && are_plate(drawing, links[link], links[link + 1])) {
      draw_plate(part_at(0), drawing, ws, links[link], links[link + 1], clip);
      link = behind;
    }
    for (; link < behind; ++link) {
      // A link is as far as its farther end, so that the joint where it begins or ends lies above it.
      const Eigen::Isometry3d X_WB = pose_of(ws, b);
      const double depth = std::min(drawing.camera.depth(X_WB * links[link].from),
                                    drawing.camera.depth(X_WB * links[link].to));
      draw_link(part_at(depth), drawing, ws, links[link], clip);
    }
    for (const PointMass& point : drawing.chain.point_masses)
      if (point.body == b) draw_point_mass(part_at(drawing.camera.depth(pose_of(ws, b) * point.at)), drawing, ws, point, clip);
    const Vector3d origin = pose_of(ws, b).translation();
    const Point center = drawing.camera.project(origin);
    if (drawing.chain.bodies[std::size_t(b)].joint.kind == JointKind::revolute && is_drawable(center)) {
      draw_revolute(part_at(drawing.camera.depth(origin)), center, drawing.look, clip);
    }
    if (has_rail) {
      if (!rails[rail].carrier) {
        draw_carriage_of(part_at(drawing.camera.depth(origin)), drawing, ws, rails[rail], clip);
      }
      ++rail;
    }
  }
  if (!is_face_on(drawing)) {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.depth < b.depth; });
  }
  for (Part& part : parts) {
    std::move(part.shapes.items.begin(), part.shapes.items.end(), std::back_inserter(picture.items));
  }
}

Vector3d root_place(const Chain& chain) {
  if (chain.frames.empty() || chain.frames[0].body != 0) return Vector3d::Zero();
  return chain.frames[0].X_BF.translation();
}

bool hangs_on_root(const Chain& chain, const Skeleton& skeleton, const Body& body) {
  return (body.joint.X_PJ.translation() - root_place(chain)).norm() <= 1e-3 * skeleton.reach;
}

Eigen::Vector3d center_of_mass(const Chain& chain, const Workspace& ws) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Inertia& inertia = chain.bodies[b].inertia;
    moment += inertia.mass * (pose_of(ws, int(b)) * inertia.com);
    mass += inertia.mass;
  }
  if (mass > 0) moment /= mass;
  return moment;
}

Eigen::Vector3d center_velocity(const Chain& chain, const Workspace& ws) {
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  double mass = 0;
  for (std::size_t b = 1; b < chain.bodies.size(); ++b) {
    const Inertia& inertia = chain.bodies[b].inertia;
    momentum += inertia.mass * (ws.v_WB[b] + ws.w_WB[b].cross(ws.X_WB[b].linear() * inertia.com));
    mass += inertia.mass;
  }
  if (mass > 0) momentum /= mass;
  return momentum;
}

bool is_followed_by_center(const Chain& chain) {
  return chain.end_effector < 0 && chain.has_floating;
}

Vector3d tip_position(const Chain& chain, const Workspace& ws) {
  return frame_position(chain, ws, chain.end_effector);
}

Point last_link(const Skeleton& skeleton, const Workspace& ws, const Camera& camera) {
  if (skeleton.links.empty()) return {};
  const LinkSegment& link = skeleton.links.back();
  return camera.project(pose_of(ws, link.body) * link.to) - camera.project(pose_of(ws, link.body) * link.from);
}

Eigen::Matrix<double, 3, 2> tip_plane(const Chain& chain, const Workspace& ws) {
  const Frame& tip = chain.frames[std::size_t(chain.end_effector)];
  return (pose_of(ws, tip.body).linear() * tip.X_BF.linear()).leftCols<2>();
}

namespace {

const Frame& frame_named(const Chain& chain, const std::string& name) {
  return chain.frames[std::size_t(find_frame(chain, name))];
}

bool is_on_ground(const Chain& chain, const std::string& name) {
  return frame_named(chain, name).body == 0;
}

// The frame that marks where the constraint closes a loop; "" where it closes none with a joint.
std::string closing_frame(const Chain& chain, const Constraint& constraint) {
  if (const auto* point = std::get_if<PointConstraint>(&constraint)) return point->frame;
  const auto* close = std::get_if<CloseConstraint>(&constraint);
  if (!close || close->kind == Closure::weld) return {};
  return is_on_ground(chain, close->a) ? close->b : close->a;
}

}  // namespace

std::vector<Eigen::Vector3d> closure_pins(const Chain& chain, const ConstraintPlan& plan) {
  std::vector<Eigen::Vector3d> pins;
  for (const Constraint& constraint : plan.list) {
    if (const auto* point = std::get_if<PointConstraint>(&constraint)) pins.push_back(point->at);
    const auto* close = std::get_if<CloseConstraint>(&constraint);
    if (!close || close->kind == Closure::weld) continue;
    for (const std::string& name : {close->a, close->b})
      if (is_on_ground(chain, name)) pins.push_back(frame_named(chain, name).X_BF.translation());
  }
  return pins;
}

void draw_closure_pins(Picture& picture, const ChainDrawing& drawing, const ConstraintPlan& plan, int clip) {
  for (const Eigen::Vector3d& pin : closure_pins(drawing.chain, plan))
    draw_pin(picture, drawing.camera.project(pin), drawing.look, clip);
}

void draw_closure_joints(Picture& picture, const ChainDrawing& drawing, const Workspace& ws,
                         const ConstraintPlan& plan, int clip) {
  for (const Constraint& constraint : plan.list) {
    const std::string name = closing_frame(drawing.chain, constraint);
    if (name.empty()) continue;
    const Frame& frame = frame_named(drawing.chain, name);
    draw_revolute(picture, drawing.camera.project(pose_of(ws, frame.body) * frame.X_BF.translation()),
                  drawing.look, clip);
  }
}

}  // namespace chainreel
