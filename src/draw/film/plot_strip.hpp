// A plot beside the scene of a clip: the whole clip's time along x, the past in full, what is to come pale,
// and a cursor at now.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "picture/plot.hpp"
#include "sim/plots.hpp"

namespace chainreel {

struct StripCurve {
  std::string label;  // at its right end; "" none
  CurveStyle style;
  std::vector<Point> points;  // (t, y), t rising; a strip keeps those without which it looks the same
  bool decides = true;        // on the range of the axis; curves of runs that went wild do not
  std::string words_above{};  // above the frame where names have no room: what no title of a panel says
  bool covers = false;        // it lies on one before it, which is seen through its gaps
  double shown_low = -HUGE_VAL, shown_high = HUGE_VAL;  // as of PlotCurve: what lies beyond decides on no axis
  std::vector<Point> marks{};  // of the points, where a step of the run ends and is seen
};

struct StripData {
  std::string title;
  bool angles = false;
  bool has_poles = false;  // masses, which are infinite at singular poses
  bool is_log = false;     // of all that is above zero
  std::vector<StripCurve> curves;
  bool of_runs = false;  // several: a curve is a run's
  bool ends_in_numbers = false;  // of its curves, which titles of panels name
  double least_span = 0;  // of the numbers' axis: what is told beyond it is noise
  std::string constancy{};  // "constant to 0.002 J", behind the title where that has room; "": it changes
  double end = 0;        // of the clip, s
  double accurate_until = HUGE_VAL;  // s: what is plotted behind it nobody promises
  std::vector<double> change_points{};  // s: of constraints that lose rank, each a thin dotted line across the frame
  std::string note{};                // above the frame, at its right end, where it has room
  std::vector<std::string> shorter_notes{};  // ... where that has none, the first that has
};

// A stretch of a curve beyond an axis that leaves it out (draw/film/needles).
struct Needle {
  Point peak;  // (t, y)
  std::size_t curve = 0;
  bool is_up = false;
};

class PlotStrip {
 public:
  PlotStrip(StripData data, const Rect& area, const PlotStyle& style);

  void draw_static(Picture& picture) const;  // axes, labels and all curves, pale
  void draw_frame(Picture& picture, double t) const;
  const PlotFrame& frame() const { return frame_; }
  const Rect& area() const { return area_; }  // with its words
  Point end_of_numbers() const { return chainreel::end_of_numbers(frame_, style_); }
  // Plots above one another begin and end at the same places.
  void narrow_to(double x0, double x1) { frame_.box.x0 = x0, frame_.box.x1 = x1; }

 private:
  void draw_note(Picture& picture, const std::string& words) const;
  void draw_change_points(Picture& picture, const std::string& note) const;

  StripData data_;
  Rect area_;
  PlotStyle style_;
  PlotFrame frame_;
  std::vector<Needle> needles_;
};

// From the lowest to the highest of those that are finite; 0 of none.
double span_of(std::span<const double> y);

// What one of the runs of a film shows in its plots.
struct StripRun {
  std::string title;  // of its panel
  bool wild = false;
  std::vector<std::vector<double>> times;  // s, of each plot's points
  std::vector<PlotCurves> plots;
  double step = 0;  // s, of a run whose steps are seen one by one
  std::vector<double> breaks{};  // s, rising: of its torques, at which steps end, too
  double accurate_until = HUGE_VAL;  // s
  std::vector<double> change_points{};  // s
  double energy_off = 0;             // J: what a run makes or loses of it that no one should take for motion
  std::string steps{};               // which do that: "semi-implicit Euler, 1 ms"
  bool is_named_by_colour = false;   // its panel's title has the colour of its curves
};

// Plot i of all runs in one; with several runs colours tell runs apart, dashes what is plotted.
StripData strip_data(const std::vector<StripRun>& runs, std::size_t i, double end, const Theme& theme);

// Height of a frame whose numbers do not lie on one another, units of H.
double least_frame(double text_scale);

// Where plots stand, and what they leave to the scene.
enum class PlotPlace { below, right, stacked };  // stacked: below, one above the other
struct PlotAreas {
  Rect scene;
  std::vector<Rect> plots;
};
// `least_below`: height of plots below the scene with their words, units of H, where the room allows. Words that grow with `text_scale` take
// their room from the scene, not from the plots below it. `beside`: share of the width of plots beside the scene. `least_each`: height of a
// plot below the scene with its words, where the room allows.
inline constexpr double kPlotsBeside = 0.38;
// What a motion leaves to plots: that share, and a height in units of H for each that does not stand beside it, up to `most` of what
// plots and scene share (0: as usual); and whether those of several panels stand beside these, or in the last cell of a grid that has so many
// `columns`.
struct PlotRoom {
  double beside = kPlotsBeside, each = 0;
  bool beside_panels = false;
  double most = 0;
  int columns = 0;
  bool without_names = false;  // of the legend, entries that tell no scale go
};
// `shares`: of the height that plots above one another share, one each; none: alike. `most`: of the page's height for plots that do not
// stand beside the scene; 0: as usual.
PlotAreas plot_areas(const Rect& page, int count, PlotPlace place, double least_below = 0, double text_scale = 1,
                     double beside = kPlotsBeside, double least_each = 0, const std::vector<double>& shares = {}, double most = 0);

// How much of that a plot needs: one of a constant or two less.
double share_of_height(const StripData& data);

}  // namespace chainreel
