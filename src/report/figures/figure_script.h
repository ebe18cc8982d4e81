#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "report/figures/gnuplot.h"
#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"
#include "subimpact/study/overlay.h"

namespace subimpact {

struct Point {
  double x, y;
};

/// The points (x(row), y(row)); x and y: members of a row, or functions of it.
template <class Row, class X, class Y>
std::vector<Point> line_of(const std::vector<Row>& rows, X x, Y y) {
  std::vector<Point> line;
  for (const Row& row : rows) line.push_back({std::invoke(x, row), std::invoke(y, row)});
  return line;
}

/// The polyline with few of its points: no point of either line is further than `tolerance` from
/// the other, coordinates measured in units of `x_scale` and `y_scale` (Ramer, Douglas and
/// Peucker), and the smallest and largest coordinates are kept as they are.
std::vector<Point> thin_out(const std::vector<Point>& line, double x_scale, double y_scale,
                            double tolerance);

struct AxisRange {
  double from, to;
};

using NumberRows = std::vector<std::vector<double>>;

/// A figure of a run: its script (figures/<name>.gp) with the tables and variables (SI) it reads.
struct FigureScript {
  std::string name, caption;
  FigureSize panels;                    ///< without the space for marks
  std::vector<std::string> marks = {};  ///< lines above the panels: warnings about the whole figure
  std::string settings = {};            ///< tables and variables, as gnuplot reads them

  /// Including the space for marks.
  FigureSize size() const;
  /// The complete script for gnuplot, with tables and variables; `scripts`: see figure_script().
  std::string text(const std::filesystem::path& scripts = {}) const;

  FigureScript& set(const std::string& variable, double value);
  /// Adds the table $name as it is.
  void table(const std::string& name, const std::string& columns, const NumberRows& rows);
  /// Adds the table $name of the columns x and y: a line, with as many points as a panel of about
  /// that size can show. `x_range`: what the panel shows of the x axis, if not all of the line.
  void line(const std::string& name, const std::vector<Point>& points, FigureSize panel,
            const std::optional<AxisRange>& x_range = {});
  /// Adds columns of the history over time as lines, tables by the names of history.csv.
  void history(std::initializer_list<const char*> columns, const std::vector<HistoryRow>& rows,
               FigureSize panel);
};

/// thin_out() to what a panel of about that size can show.
std::vector<Point> thin_for_panel(const std::vector<Point>& line, FigureSize panel,
                                  const std::optional<AxisRange>& x_range = {});

/// The figures of a run for which it has data, marked if the run did not complete.
std::vector<FigureScript> figure_scripts(const Case& input, const Result& result);

FigureScript response_figure(const Case& input, const Result& result);
FigureScript first_sub_impact_figure(const Case& input, const Result& result);
FigureScript indentation_figure(const Case& input, const Result& result);
FigureScript energies_figure(const Case& input, const Result& result);
FigureScript timeline_figure(const Case& input, const Result& result);
FigureScript bending_figure(const Case& input, const Result& result);
FigureScript shapes_figure(const Case& input, const Result& result);
FigureScript envelope_figure(const Case& input, const Result& result);
FigureScript measured_figure(const Overlay& overlay);
FigureScript strikes_figure(const Case& input, const Result& result);

/// Sections that `bending` has room for: the first ones of output.sections.
inline constexpr std::size_t most_bending_panels = 24;

}  // namespace subimpact
