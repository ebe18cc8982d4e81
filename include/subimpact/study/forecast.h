#pragma once

/// What run_as_asked() will do with a case, without doing it.

#include <string>
#include <vector>

#include "subimpact/study/run_as_asked.h"

namespace subimpact {

/// A run that run_as_asked() will make.
struct ForecastRun {
  int level = 1;           ///< its mesh in the order of the search, from 1
  bool is_beside = false;  ///< it judges the run of its level
  std::string mesh;        ///< "257 cells", "rigid, rtol = 1e-07"
  std::string method;      ///< as in case files
  double work = 0.0;       ///< counted_work()
  double seconds = 0.0;    ///< of a processor
  bool is_made = false;    ///< for the forecast: its time is measured
  int n_runs = 1;          ///< more: runs with numbers that scatter, on a coarser mesh where dear
};

/// What all runs take, with reading, judging and files.
struct ForecastCost {
  std::vector<ForecastRun> runs;
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
};

struct RunForecast {
  ChosenModel first;  ///< first_run()
  Jobs jobs = 1;
  ForecastCost expected;
  /// If the first level that is not made for the forecast meets the tolerance, and if no further
  /// sub-impact becomes certain before the limit of work.
  ForecastCost least, most;
  double memory = 0.0;  ///< bytes, that suffice for the process
};

/// Makes the cheap levels of the search, with its own rules, and extrapolates the others: work and
/// time grow as from mesh to mesh of those that were made, errors fall with the order of the mesh.
/// Whether a level is made depends on its counted work alone. Of several strikes, the first.
/// Throws InvalidCase.
RunForecast forecast(const Case& input, const GivenKeys& given, Jobs jobs);

}  // namespace subimpact
