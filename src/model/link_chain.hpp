// A serial chain in a few numbers, in the place of a URDF file: what `model: {links: ..}` of a scene holds, and what
// `chainreel init --links` writes a URDF of. Both take the text of the same URDF, so that a chain is built in one place.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"

namespace chainreel {

enum class LinkMass { rod, point };
std::span<const Name> names_of(LinkMass);

// Whose rule the rows of Denavit and Hartenberg follow.
enum class DhConvention { standard, modified };
std::span<const Name> names_of(DhConvention);

using DhRow = std::array<double, 4>;  // a (m), alpha (rad), d (m), theta (rad); the joint adds to theta or d
inline constexpr std::array<bool, 4> kDhAngle = {false, true, false, true};

inline constexpr std::size_t kMostLinks = 100;

// Lists of one number a link may be one number for all.
struct LinkChain {
  std::vector<double> links;    // lengths, m; empty where there is `dh`
  std::vector<DhRow> dh;        // in the place of lengths
  DhConvention convention = DhConvention::standard;
  std::vector<double> masses;   // kg; empty: 1 each
  std::vector<double> damping;  // N m s/rad, of sliding joints N s/m; empty: none
  std::vector<double> efforts;  // that the joints are limited to, N m or N; empty: without end
  std::string joints;           // a letter each, R or P, maybe with its axis: "RRP", "RzPx"; "": all turn
  LinkMass shape = LinkMass::rod;

  std::size_t size() const { return dh.empty() ? links.size() : dh.size(); }
  friend bool operator==(const LinkChain&, const LinkChain&) = default;
};

// Fills in what was left out, a number a link. Returns what is wrong, each with its key: "masses".
struct LinkProblem {
  std::string key, message;
};
std::vector<LinkProblem> complete(LinkChain& chain);

// In one line of YAML: {links: [0.5, 0.4], masses: [1, 1], joints: RR, shape: rod}.
std::string text_of(const LinkChain& chain);

// Links link1, link2 .. behind joints joint1, joint2 .., from `base` to `gripper`. At zero all lie along x. R turns about
// z; P slides along x, a P right behind another one across it. A rod is thin and uniform; about itself it turns like a
// cylinder of 3 % of the longest link in radius, and without length like such a ball. A point has its mass at the end.
// Of `dh` the frames behind the joints are links frame1, frame2 .. too (of `modified`, axis1, axis2 .. before them).
// `chain` is complete.
std::string urdf_of(const LinkChain& chain, const std::string& name);

}  // namespace chainreel
