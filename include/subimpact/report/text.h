#pragma once

/// Results and studies as text for people, in microseconds, millimetres and newtons, and as CSV and
/// JSON files.

#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/study/studies.h"

namespace subimpact {

/// For tables and figures of a run that did not complete: how the run ended and up to which time
/// the results passed every check, in one line; empty for a run that completed.
std::string outcome_caveat(const Result& result);

/// How certain a run is, in one line: the error of the certain times, and why the first uncertain
/// sub-impact is not certain.
std::string error_words(const Result& result);

/// ", 9 certain", ", all certain": continues a number of sub-impacts. Empty without error estimate.
std::string certain_words(const Result& result);

/// Whether a tolerance on event times was met, in one line: horizon, error, reason, key to free.
std::string tolerance_words(const ToleranceOutcome& tolerance, const Result& result);

/// The strikes of a beam that was struck several times, one line each; unless `all`, of more than
/// twenty only a selection that gets sparser.
std::string strike_table(const Result& result, bool all = true);

/// One line per sub-impact, under a heading with units; zones and sub-zones are separated. Begins
/// with outcome_caveat(). Numbers have the digits that their errors allow; sub-impacts that are not
/// certain have question marks. `fold`: three or more of these in succession are one line.
std::string sub_impact_table(const Result& result, bool fold = true);

/// Why contact is over, or how close striker and beam come after the last sub-impact.
std::string contact_over_words(const Result& result);

/// What finer meshes change in a run whose case fixes the mesh, for a result whose error estimate
/// has finer_meshes.
std::string finer_meshes_words(const Result& result);

/// Sets Result::answers and Result::verdict, with their words: the only place that makes them.
void make_answers(const Case& input, Result& result);

/// The title and the strike, the verdict, the answers with both errors of each, what the largest
/// errors of the body come from, doubts and warnings; lines of at most 100 columns. `verbose` adds
/// all parts, how the run was made and what it took. Of a result with answers (make_answers).
std::string run_summary(const Case& input, const Result& result, bool verbose = false);

/// The version of the layout of report.json, its key "layout".
constexpr int report_layout = 1;

/// report.json: what a page shows of a run beside summary.json and its tables, rounded as the
/// screen rounds it. Of a result with answers (make_answers).
std::string report_json(const Case& input, const Result& result);

/// For a run that did not complete: one line with time, mode, method, last event, cause, the times
/// between which the first check failed and, where the scene is outside the validity of the model,
/// values with doubtful units.
std::string failure_message(const Case& input, const Result& result);

/// One line per method, with its differences from the reference, also in words.
std::string comparison_table(const Comparison& comparison);

/// What several models say of the strike and of every sub-impact, with errors, and how much later
/// these come than by the first model; then a sentence that compares each model with the first.
std::string model_table(const std::vector<ModelRun>& runs);

/// What a run of a case will take, and what the first of its runs models, why. Throws InvalidCase.
std::string explanation(const Case& input, const GivenKeys& given);

/// Keys of a case file, with units, what they accept and their defaults: all, or those with a word,
/// in whatever case, in name, meaning or choices.
std::string key_listing(const std::string& word = "");

/// The methods and their Butcher tables, one line each.
std::string method_listing();

/// A duration in the unit that suits its size: "12.3 us", "8 ms", "3.4 s".
std::string duration_text(double seconds);

/// comparison.csv, one row per method, and matches.csv, one row per method and sub-impact.
std::string comparison_csv(const Comparison& comparison);
std::string matches_csv(const Comparison& comparison);

/// The reference, one line per point, and why a point is not right, in words.
std::string work_precision_table(const WorkPrecision& study);

/// One sentence for each wanted error.
std::string recommendation_text(const std::vector<Recommendation>& recommendations);

/// work_precision.csv: one row per point of each study.
std::string work_precision_csv(const std::vector<WorkPrecision>& studies);

/// case_identity() without the outputs and what a study sets (method, table, tolerance, step).
std::string case_id(const Case& input);

/// One letter for each run, and outcomes.csv, one row for each.
std::string outcome_table(const OutcomeMap& map);
std::string outcomes_csv(const OutcomeMap& map);

}  // namespace subimpact
