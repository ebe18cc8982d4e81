#pragma once

/// The files a finished run leaves behind.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"
#include "subimpact/study/compare.h"

namespace subimpact {

/// The version of the layout of summary.json, its key "layout": raised when a key is renamed, moved
/// or removed. 1: files without that key.
constexpr int summary_layout = 3;

/// A file or directory that cannot be written; `what()` names it, the cause and what to do.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Makes the directory and tries it out, so that a run is not made for nothing. Throws OutputError.
void prepare_output_directory(const std::filesystem::path& directory);

/// Writes events.csv, transitions.csv, history.csv and summary.json, and sections.csv if sections
/// were asked for. Each file appears whole or not
/// at all: it is written under another name and then moved into place. Throws OutputError.
void write_results(const std::filesystem::path& directory, const Case& input, const Result& result);

/// Writes comparison.csv (one row per method) and matches.csv (one row per method and sub-impact).
void write_comparison(const std::filesystem::path& directory, const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);
std::string matches_csv(const Comparison& comparison);

/// The contents of the files of a run. Numbers in CSV carry 17 significant digits, enough to read
/// the same double back; a sub-impact that has not ended has empty end and duration columns.
std::string events_csv(const std::vector<SubImpact>& sub_impacts);
std::string transitions_csv(const std::vector<Transition>& transitions);
std::string history_csv(const std::vector<HistoryRow>& history);
std::string sections_csv(const std::vector<SectionRow>& sections);
/// JSON has no infinity and no NaN: an infinite setting is written as the text "inf", a result that
/// is not finite as null.
std::string summary_json(const Case& input, const Result& result);

/// What the sub-impacts of one zone amount to.
struct ZoneSummary {
  int zone = 0;
  int n_sub_impacts = 0;
  int n_subzones = 0;
  double start = 0.0;         ///< s
  std::optional<double> end;  ///< s; none: still in contact
  double impulse = 0.0;       ///< N s
  double peak_force = 0.0;    ///< N
};
std::vector<ZoneSummary> summarise_zones(const std::vector<SubImpact>& sub_impacts);

}  // namespace subimpact
