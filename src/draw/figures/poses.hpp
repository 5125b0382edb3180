// Still figures of a chain at chosen poses.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "draw/layers/ellipse.hpp"
#include "draw/page/sheet.hpp"
#include "draw/robot/body_shapes.hpp"
#include "draw/robot/view.hpp"
#include "model/chain.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"
#include "scene/scene.hpp"
#include "sim/instant.hpp"

namespace chainreel {

inline constexpr double kOnionSkin = 0.25;  // opacity of all poses but the last
inline constexpr int kSceneClip = 0;        // of a picture with one scene

struct PoseFigureOptions {
  std::string title;
  int width = 1920;  // of the page, px: only their ratio counts
  int height = 1080;
  double text_scale = 1;
  const Theme* theme = &light_theme();
  CameraEntry camera;
  std::shared_ptr<const BodyShapes> shapes;  // drawn instead of bars
  std::optional<PageLogo> logo{};            // on whole pixels of the page, whatever it says of them

  // For figures with ellipses:
  EllipseReading reading = EllipseReading::mass;
  bool section = false;               // by the xy plane of the end effector, instead of the ellipsoid
  std::string layout = "grid";        // panels, so many across as lets them be largest; or row: all in one; or
                                      // superposed: no panels
  int across = 0;                     // panels of a grid beside one another; 0: as many
  bool letters = false;               // (a), (b), .. before the captions of panels
  std::vector<std::string> labels;    // "t = 0.5 s", one a panel; may be empty
  std::vector<Eigen::Vector3d> path;  // of the end effector, m: drawn below superposed poses
  double cell = 0;  // m: above 0 the poses are a field, each ellipse in a square of this side about its point
  std::string branch{};  // ... at the one of several poses there that these words say
};
const std::vector<std::string>& figure_layout_names();
// The page in a unit of its own: of what is higher than a slide the height of a slide as wide, so that words and marks do not grow with
// a page that has more rows. `options` with it for a page, and how many units the page is high.
struct PageInUnits {
  PoseFigureOptions options;
  double height = 1;
};
PageInUnits in_units(PoseFigureOptions options);
std::optional<PageLogo> logo_of(const PoseFigureOptions& options);

// The chain at every pose in one place: the last one in full, those before it as onion skins of 25 %.
Picture draw_pose_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                         const PoseFigureOptions& options, const Fonts& fonts);

// The camera of such a figure.
KeptCamera camera_of_poses(const Chain& chain, const std::vector<std::vector<double>>& poses, const PoseFigureOptions& options,
                           const Fonts& fonts);
// Whether a figure of this pose, by the camera of the options, cuts something off.
bool leaves_page(const Chain& chain, const std::vector<double>& q, const PoseFigureOptions& options,
                 const Fonts& fonts);

// One panel a pose, all at the same scale: the chain, its effective-mass ellipse, and below them the pose and the
// numbers of Lambda, of five poses and more on one line; at singular poses an open band and the masses along its axes. Superposed: every chain as an
// onion skin of 25 %, every ellipse at full strength. A field: the chain where its ellipse is roundest alone.
// `numbers_left_out`: where it is not null, how many semi-axes that were to have a number have none, for want of room.
Picture draw_ellipse_figure(const TipMass& mass, const std::vector<std::vector<double>>& poses,
                            const PoseFigureOptions& options, const Fonts& fonts, int* numbers_left_out = nullptr);

// How well poses fit on a page as that figure.
struct PoseFigureFit {
  double metre = 0, kilogram = 0;  // on the page, of its width; 0: there is no room
  bool is_whole = false;           // each pose stands below its picture as it is
  bool has_masses = false;         // ... and so does its Lambda, or the masses along its axes
  bool has_matrices = false;       // ... Lambda itself
  bool has_lengths = false;        // semi-axes have their numbers
  bool is_compact = false;         // of many poses: captions of one line, and pictures have most of their cells
};
PoseFigureFit fit_of_poses(const TipMass& mass, const std::vector<std::vector<double>>& poses, const PoseFigureOptions& options,
                           const Fonts& fonts);

// For each pose the chain, the unit circle of accelerations of two joints, and its image under M(q) in the space of their
// torques, the other joints not accelerating, in blocks so many across as lets them be largest. `joints` from 0. Throws
// Error (usage) where the page has no room for the axes beside their words.
Picture draw_joint_space_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                                std::array<int, 2> joints, const PoseFigureOptions& options,
                                const Fonts& fonts);

bool joint_space_has_room(const Chain& chain, const std::vector<std::vector<double>>& poses, std::array<int, 2> joints,
                          const PoseFigureOptions& options, const Fonts& fonts);

// How high its page is to be, px, so that its squares are as large as the width allows; nothing where no height is enough.
// `options`: a page of that width, whose words are of the size that they are to have.
std::optional<double> joint_space_height(const Chain& chain, const std::vector<std::vector<double>>& poses,
                                         std::array<int, 2> joints, const PoseFigureOptions& options, const Fonts& fonts);

}  // namespace chainreel
