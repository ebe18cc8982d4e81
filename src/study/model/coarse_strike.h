#pragma once

#include <cmath>
#include <optional>

#include "subimpact/case/case.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Openings (m) up to which two contacts count as one where models are compared: thinner ones come
/// and go with mesh, law and theory.
inline constexpr double hair_opening = 1e-6;

/// The scene on about so many equal cells, up to `end` (s) or until no contact can follow: by
/// central differences, at the strike on an end and with damping by what takes them. Without rows,
/// but with the set at the end. A rigid beam has no cells.
Case coarse_case(const Case& input, int cells, double end);

/// The most cells, up to `most`, with which such a run keeps to the work (counted_work); at least
/// some 50; 0 where these would take 20 times as much.
int affordable_cells(const Case& input, double end, int most, double work);

/// With a step that is stable. Nothing where the case cannot be run.
std::optional<Result> coarse_run(Case input, const Progress& progress = {});

/// Parting, largest force and indentation are those of contacts up to a time (s).
StrikeFigures figures_of(const Result& result, double until = HUGE_VAL);

}  // namespace subimpact
