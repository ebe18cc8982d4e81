#pragma once

/// The tables of a population of runs, as `subimpact-sweep` writes them.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/simulate/records.h"

namespace subimpact {

struct SweptRuns {
  /// A column of runs.csv with one value per run: numbers, NaN where a cell is empty; or words,
  /// where some cell is no number.
  struct Column {
    std::string name;
    bool is_key = false;  ///< of the case, with different values
    std::vector<double> numbers;
    std::vector<std::string> words;
  };
  std::string identity;         ///< of these tables; empty if no manifest.json has one
  std::vector<long> numbers;    ///< of the runs, in the plan
  std::vector<Column> columns;  ///< without those that have no values
  std::vector<std::vector<SubImpact>> sub_impacts;  ///< one list per run

  /// nullptr if there is no such column, or one without values.
  const Column* find(std::string_view name) const;
};

/// Whether a directory holds the tables of a sweep, and not the files of one run.
bool holds_sweep(const std::filesystem::path& directory);

/// Reads runs.csv and sub_impacts.csv, which must be those that manifest.json lists, if there is
/// one. Throws ResultsError with file, line, what was found and what to do, also where there is no
/// run.
SweptRuns read_sweep(const std::filesystem::path& directory);

}  // namespace subimpact
