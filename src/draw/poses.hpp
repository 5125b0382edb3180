// Still figures of a chain at chosen poses.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "picture/text.hpp"
#include "picture/theme.hpp"

namespace chainreel {

struct PoseFigureOptions {
  std::string title;
  int width = 1920;  // of the page, px: only their ratio counts
  int height = 1080;
  double text_scale = 1;
  const Theme* theme = &light_theme();
};

// The chain at every pose in one place: the last one in full, those before it as onion skins of 25 %.
Picture draw_pose_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                         const PoseFigureOptions& options, const Fonts& fonts);

// One panel a pose, at most four across, all at the same scale: the chain, its effective-mass ellipse, and
// below them the pose and the numbers of Lambda; at singular poses an open band and the direction of infinite
// mass.
Picture draw_ellipse_figure(const Chain& chain, const std::vector<std::vector<double>>& poses,
                            const PoseFigureOptions& options, const Fonts& fonts);

}  // namespace chainreel
