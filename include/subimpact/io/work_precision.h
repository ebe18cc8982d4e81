#pragma once

/// A work-precision study as text and file.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/work_precision.h"

namespace subimpact {

/// The reference, one line a point, what went wrong in words.
std::string work_precision_table(const WorkPrecision& study);

/// One sentence for each wanted error.
std::string recommendation_text(const std::vector<Recommendation>& recommendations);

/// work_precision.csv in a directory, written point by point, so that an interrupted study keeps
/// what it has and a repeated one goes on from there.
class PointLog {
 public:
  /// Reads what an earlier study of the same cases left, and appends to it. `cases` are the ids of
  /// the cases of this study. Throws OutputError if the file cannot be written, or holds points of
  /// other cases.
  PointLog(const std::filesystem::path& directory, const std::vector<std::string>& cases);

  /// A point of an earlier study.
  std::optional<WorkPrecisionPoint> known(const std::string& case_id, const Setting& setting) const;
  std::size_t n_known() const { return known_.size(); }
  /// Writes a row and sees it to the disk. Throws OutputError.
  void append(const std::string& case_id, const std::string& label,
              const WorkPrecisionPoint& point);

 private:
  std::filesystem::path path_;
  std::map<std::string, WorkPrecisionPoint> known_;
};

/// Tells cases apart: a fingerprint of the program's version and of all keys of the case but those
/// a study sets itself (method, table, tolerance, step), the title and the outputs.
std::string case_id(const Case& input);

}  // namespace subimpact
