#pragma once

/// A work-precision study as text and file.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/io/output_directory.h"
#include "subimpact/study/work_precision.h"

namespace subimpact {

/// The reference, one line per point, and why a point is not right, in words.
std::string work_precision_table(const WorkPrecision& study);

/// One sentence for each wanted error.
std::string recommendation_text(const std::vector<Recommendation>& recommendations);

/// work_precision.csv in a directory, written point by point, so that an interrupted study keeps
/// its points and a repeated study continues from there.
class PointLog {
 public:
  /// Reads the file of an earlier study of the same cases, and goes on from its points. `cases` are
  /// the ids of the cases of this study. Throws OutputError if the file cannot be written, or holds
  /// points of other cases, and ResultsError if it was changed since.
  PointLog(OutputDirectory& directory, const std::vector<std::string>& cases);

  /// A point of an earlier study.
  std::optional<WorkPrecisionPoint> known(const std::string& case_id, const Setting& setting) const;
  std::size_t n_known() const { return known_.size(); }
  /// Commits the file with a row more. Throws OutputError.
  void append(const std::string& case_id, const std::string& label,
              const WorkPrecisionPoint& point);

 private:
  OutputDirectory& directory_;
  std::string text_;
  std::map<std::string, WorkPrecisionPoint> known_;
};

/// Identifies a case: a fingerprint of the program's version and of all keys of the case but those
/// a study sets itself (method, table, tolerance, step), the title and the outputs.
std::string case_id(const Case& input);

}  // namespace subimpact
