#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "subimpact/io/read_results.h"

namespace subimpact {

/// Refuses what no run can have written, row by row, in the order of a table: numbers that are not
/// finite, times that decrease, zones that are not numbered from 1. Throws ResultsError with file,
/// line, value and what is allowed.
class RowChecks {
 public:
  explicit RowChecks(std::string file) : file_(std::move(file)) {}

  void check(const SubImpact& row);
  void check(const Transition& row);
  void check(const HistoryRow& row);
  void check(const SectionRow& row);
  void check(const PointRow& row);
  void check(const ShapeRow& row);
  void check(const EnvelopeRow& row);

 private:
  void check_finite(const char* column, double value) const;
  void check_time(const char* column, double time);
  [[noreturn]] void refuse(const char* column, double value, const char* allowed) const;

  std::string file_;
  std::size_t line_ = 1;  // the heading
  double last_time_ = -std::numeric_limits<double>::infinity();
  int last_zone_ = 0, last_subzone_ = 0;
};

/// The same for the numbers of summary.json on which figures and pages rely. Throws ResultsError.
void check_summary(const std::string& file, const FinishedRun& run);

}  // namespace subimpact
