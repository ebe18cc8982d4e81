#pragma once

#include <memory>

#include "simulate/recorder.h"
#include "simulate/run_parts.h"

namespace subimpact {

inline bool goes_on(const Problem& problem) {
  return goes_on(problem.start.get(), problem.striker, problem.at_rest);
}

/// Refuses (InvalidCase) a start of another mesh, section, contact law or struck point, an end
/// before it, and a gap before a beam that moves.
void check_continuation(const Problem& problem, const Options& options,
                        const ResolvedSettings& used);

/// Puts the beam into the state that Problem::start describes. Throws InvalidCase.
void begin_from(const RunState& start, RunParts& parts);
/// Its accounts and records, where the run continues the strike of that state.
void read_records(const RunState& start, Audit& audit, Recorder& recorder);

/// Of a run that has reached `time` (s) and y, before its records are closed.
std::shared_ptr<const RunState> end_state(RunParts& parts, double time, State y, Audit& audit,
                                          Recorder& recorder);

}  // namespace subimpact
