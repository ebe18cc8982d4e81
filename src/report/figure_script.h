#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/gnuplot.h"
#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

struct Point {
  double x, y;
};

/// The polyline with few of its points: no point of either line is further than `tolerance` from
/// the other, coordinates measured in units of `x_scale` and `y_scale` (Ramer, Douglas and
/// Peucker), and the smallest and largest coordinates are kept as they are.
std::vector<Point> thin_out(const std::vector<Point>& line, double x_scale, double y_scale,
                            double tolerance);

/// Part of a figure that a panel's axes enclose, in fractions of its width and height.
struct Box {
  double left, right, bottom, top;
};

/// The part of an axis that a figure shows.
struct AxisRange {
  double from, to;
};

/// A gnuplot script in the making, data included.
class FigureScript {
 public:
  FigureScript(std::string name, std::string caption, FigureSize size);

  const std::string& name() const { return name_; }
  const std::string& caption() const { return caption_; }
  /// With the room that marks take.
  FigureSize size() const;
  /// Writes a line across the top, above the panels: what to know before looking at it.
  void mark(const std::string& text) { marks_.push_back(text); }
  /// The script as gnuplot wants it: data first, then the panels as one multiplot.
  std::string text() const;

  /// Adds a line of data, thinned to what the figure can show over the given part of it; returns
  /// its gnuplot name. `x_range`: what the panel shows of the x axis, if not all of the line.
  std::string line(const std::vector<Point>& points, const Box& box,
                   const std::optional<AxisRange>& x_range = {});
  /// Adds points as they are.
  std::string points(const std::vector<Point>& points);

  FigureScript& operator<<(const std::string& commands) {
    commands_ += commands;
    return *this;
  }
  /// Places the panel that the next plot command draws.
  void place(const Box& box);
  /// Vertical bands behind the panel.
  struct Band {
    double from, to;
    const char* colour;
  };
  void shade(const std::vector<Band>& bands);

 private:
  std::string name_, caption_;
  FigureSize size_;
  std::vector<std::string> marks_;
  std::string data_;
  std::string commands_;
  int n_data_ = 0;
};

/// A spacing of tics, 1, 2 or 5 times a power of ten, that cuts an extent into about `parts`.
double tic_spacing(double extent, int parts);

/// A unit that suits the size of what is shown: values of the SI unit times `factor` are in `name`.
struct Unit {
  double factor;
  const char* name;
};
Unit force_unit(double largest);   ///< of a force in N
Unit length_unit(double largest);  ///< of a displacement in m
Unit energy_unit(double largest);  ///< of an energy in J
/// The largest magnitude of a column of the history.
double largest(const Result& result, double HistoryRow::*member);

/// How times of a run are shown: its unit suits its length.
struct TimeUnit {
  double per_second;
  const char* name;
};
TimeUnit time_unit(double length);

// Light enough to lie behind lines; the second is for zones, the third for sub-zones.
inline constexpr const char* band_colour = "#FBE6BE";
inline constexpr const char* zone_colour = "#E3E3E3";
inline constexpr const char* subzone_colour = "#BDBDBD";

/// One band a sub-impact, in the given unit of time.
std::vector<FigureScript::Band> sub_impact_bands(const Result& result, TimeUnit unit);

/// A column of the history as a line over time.
std::vector<Point> history_line(const Result& result, TimeUnit unit, double HistoryRow::*member,
                                double factor);

// The figures; each nothing but a function of a run.
FigureScript response_figure(const Case& input, const Result& result);
FigureScript first_sub_impact_figure(const Case& input, const Result& result);
FigureScript indentation_figure(const Case& input, const Result& result);
FigureScript energies_figure(const Case& input, const Result& result);
FigureScript timeline_figure(const Case& input, const Result& result);
FigureScript bending_figure(const Case& input, const Result& result);

/// Sections that `bending` has room for: the first ones of output.sections.
inline constexpr std::size_t most_bending_panels = 24;

}  // namespace subimpact
