#include "app/paper/pose_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace chainreel {
namespace {

// A height to begin with, mm: so many panels across as columns of a paper hold, each with its caption; or one picture.
double usual_height(double width, int panels, bool is_one_picture) {
  constexpr double kShape = 0.75, kCaption = 6, kMatrix = 17, kFoot = 16;
  if (is_one_picture) return kShape * width + kFoot;
  const int across = panels == 1 ? 1 : panels <= 4 ? 2 : panels <= 9 ? 3 : 4, rows = (panels + across - 1) / across;
  return rows * (kShape * width / across + (panels < 5 ? kMatrix : kCaption)) + kFoot;
}

// How well poses are shown on a page: first by what stands below them, then by how large they are on so much paper.
struct PageOfPoses {
  double height = 0;  // mm
  int words = -1;
  bool is_compact = false;
  double metre = 0, kilogram = 0, merit = 0;
};

// Of panels so many across, as high as lets chains be as large as the width allows, and ellipses all but so, with the words that there are
// then.
PageOfPoses page_of_poses(const std::function<PoseFigureFit(double)>& fit_at, double tallest, double width, bool wants_lengths) {
  constexpr double kAsLarge = 0.96, kEllipses = 0.7, kFlattest = 0.2, kStep = 1, kWithoutMatrix = 0.8;  // of the size, of the width, mm
  constexpr double kWithoutLengths = 0.3, kLines = 0.1;
  constexpr double kHeight = 1.5;  // the smaller page is the better one, even where it shows things somewhat smaller
  const auto page_at = [&](double height) {
    const PoseFigureFit fit = fit_at(height);
    PageOfPoses page{height, fit.metre > 0 ? 2 * int(fit.is_whole) + int(fit.has_masses) : -1, fit.is_compact, fit.metre, fit.kilogram, 0};
    page.merit = (fit.has_matrices ? 1 : kWithoutMatrix) * (fit.has_lengths || !wants_lengths ? 1 : kWithoutLengths) * (fit.is_compact ? 1 : kLines) *
                 std::sqrt(fit.metre * fit.kilogram) / std::pow(height, kHeight);
    return page;
  };
  PageOfPoses page = page_at(tallest);
  const PageOfPoses wished = page;
  for (double low = kFlattest * width; page.height - low > kStep;) {
    const PageOfPoses tried = page_at((low + page.height) / 2);
    if (tried.metre >= kAsLarge * wished.metre && tried.kilogram >= kEllipses * wished.kilogram && tried.words == page.words && tried.is_compact == page.is_compact)
      page = tried;
    else
      low = tried.height;
  }
  return page;
}

}  // namespace

void set_page(PoseFigureOptions& figure, const PaperPage& page, double text_scale) {
  figure.width = page.width;
  figure.height = page.height;
  figure.text_scale = text_scale_on(page, text_scale);
}

void put_on_paper(PoseFigureOptions& figure, const PaperOptions& paper, const TipMass& tip, const std::vector<std::vector<double>>& poses,
                  const Fonts& fonts) {
  constexpr int kMostAcross = 6, kFew = 4;  // poses whose semi-axes are worth a higher page for their numbers
  constexpr double kTallestPanel = 1.25;  // of its width, with its caption
  const double width = paper.width_mm, text_scale = figure.text_scale;
  const int count = int(poses.size());
  const bool is_row = figure.layout == "row", is_one_picture = figure.layout == "superposed" || figure.cell > 0;
  const auto page = [&](double height, int across) {
    PoseFigureOptions tried = figure;
    tried.across = across;
    set_page(tried, paper_page(paper, height), text_scale);
    return tried;
  };
  PageOfPoses best{.height = usual_height(width, is_row ? 1 : count, is_one_picture)};
  int best_across = 0;
  if (!is_one_picture && paper.height_mm == PaperOptions::kNotGiven)
    for (int across = is_row ? count : 1; across <= (is_row ? count : std::min(count, kMostAcross)); ++across) {
      const int rows = (count + across - 1) / across;
      const double tallest = std::min(tallest_page(paper), kTallestPanel * width * rows / across + usual_height(width, count, true));
      const PageOfPoses tried = page_of_poses([&](double height) { return fit_of_poses(tip, poses, page(height, across), fonts); }, tallest, width,
                                              count <= kFew);
      if (std::pair(tried.words, tried.merit) <= std::pair(best.words, best.merit)) continue;
      best = tried;
      best_across = across;
    }
  figure = page(std::ceil(best.height), best_across);
}

void cut_row(PoseFigureOptions& figure, const TipMass& tip, const std::vector<std::vector<double>>& poses, const Fonts& fonts) {
  const PoseFigureOptions slide = figure;
  const auto page = [&](double height) {
    PoseFigureOptions tried = slide;
    tried.height = 2 * int(std::ceil(height / 2));
    tried.text_scale = slide.text_scale * slide.height / tried.height;  // of the page's height
    return tried;
  };
  const PageOfPoses best = page_of_poses([&](double height) { return fit_of_poses(tip, poses, page(height), fonts); }, slide.height, slide.width, false);
  if (best.words >= 0) figure = page(best.height);
}

}  // namespace chainreel
