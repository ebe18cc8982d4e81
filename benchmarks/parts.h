#pragma once

#include <span>

#include "measure.h"

namespace subimpact::benchmarks {

/// One comparison: measures and prints its table to stdout.
struct Part {
  const char* name;
  const char* question;  ///< one line for --help
  void (*run)(const Settings& settings);
};

std::span<const Part> all_parts();

// What the parts are; each in the file of its name.
void measure_naive(const Settings& settings);
void measure_vectors(const Settings& settings);
void measure_evaluation(const Settings& settings);
void measure_reversals(const Settings& settings);
void measure_events(const Settings& settings);
void measure_exponential(const Settings& settings);
void measure_mesh(const Settings& settings);
void measure_total_error(const Settings& settings);
void measure_tables(const Settings& settings);

}  // namespace subimpact::benchmarks
