#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/records/record.h"
#include "subimpact/io/results.h"

namespace subimpact {

// Enumerations of a result, under the names that to_string() gives them.
std::span<const Named<OutcomeKind>> names_of(OutcomeKind);
std::span<const Named<NearMissKind>> names_of(NearMissKind);
std::span<const Named<EventKind>> names_of(EventKind);

/// What summary.json describes: a run and the programs that made it.
struct DescribedRun {
  Case* input;
  Result* result;
  std::string program_version;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and version
};

const Record<DescribedRun>& run_record();

/// A member of summary.json that is a number, a word or a text.
struct NamedScalar {
  std::string name, meaning, value;
};

/// All entries of summary.json for a run, except lists and entries that do not apply, in order.
std::vector<NamedScalar> scalars_of(const FinishedRun& run);

/// Reads what summary.json holds of a run; `path` is for messages. Throws ResultsError, also for
/// numbers that no run can have written.
void read_summary(const std::filesystem::path& path, const std::string& text, FinishedRun& run);

}  // namespace subimpact
