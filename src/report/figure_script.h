#pragma once

#include <cstddef>
#include <filesystem>
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

/// The part of an axis that a figure shows.
struct AxisRange {
  double from, to;
};

using NumberRows = std::vector<std::vector<double>>;

/// A figure of a run: its script (figures/<name>.gp), and the tables and variables that the script
/// reads.
class FigureScript {
 public:
  FigureScript(std::string name, std::string caption, FigureSize size);

  const std::string& name() const { return name_; }
  const std::string& caption() const { return caption_; }
  /// Including the space for marks.
  FigureSize size() const;
  /// Writes a line across the top, above the panels: a warning about the whole figure.
  void mark(const std::string& text) { marks_.push_back(text); }
  /// The complete script for gnuplot, with tables and variables; `scripts`: see figure_script().
  std::string text(const std::filesystem::path& scripts = {}) const;

  FigureScript& set(const std::string& variable, double value);
  FigureScript& set(const std::string& variable, const std::string& value);
  /// Adds the table $name as it is.
  void table(const std::string& name, const std::string& columns, const NumberRows& rows);
  /// Adds the table $name of the columns x and y: a line, with as many points as a panel of about
  /// that size can show. `x_range`: what the panel shows of the x axis, if not all of the line.
  void line(const std::string& name, const std::vector<Point>& points, FigureSize panel,
            const std::optional<AxisRange>& x_range = {});

 private:
  std::string name_, caption_;
  FigureSize size_;
  std::vector<std::string> marks_;
  std::string settings_;
};

/// thin_out() to what a panel of about that size can show.
std::vector<Point> thin_for_panel(const std::vector<Point>& line, FigureSize panel,
                                  const std::optional<AxisRange>& x_range = {});

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

/// Adds the tables $<name> and $<name>_undecided of a band (from, to) per decided and undecided
/// sub-impact, in the given unit of time, and the variable n_undecided. Without an error estimate
/// all count as decided.
void add_sub_impact_bands(FigureScript& figure, const std::string& name, const Result& result,
                          TimeUnit unit);

/// A column of the history as a line over time.
std::vector<Point> history_line(const Result& result, TimeUnit unit, double HistoryRow::*member,
                                double factor);

// The figures; each is a function of a run.
FigureScript response_figure(const Case& input, const Result& result);
FigureScript first_sub_impact_figure(const Case& input, const Result& result);
FigureScript indentation_figure(const Case& input, const Result& result);
FigureScript energies_figure(const Case& input, const Result& result);
FigureScript timeline_figure(const Case& input, const Result& result);
FigureScript bending_figure(const Case& input, const Result& result);
FigureScript shapes_figure(const Case& input, const Result& result);
FigureScript envelope_figure(const Case& input, const Result& result);
/// Those for which the run has data, marked if the run did not complete.
std::vector<FigureScript> figure_scripts(const Case& input, const Result& result);

/// Sections that `bending` has room for: the first ones of output.sections.
inline constexpr std::size_t most_bending_panels = 24;

}  // namespace subimpact
