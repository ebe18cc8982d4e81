#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "byte_source.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "targets.h"

namespace subimpact::fuzz {
namespace {

constexpr int most_steps = 200;
constexpr int most_cells = 61;
constexpr double most_rows = 1e4;

constexpr const char* base = R"(
[beam]
length = 0.7
width = 0.016
thickness = 0.0075
density = 2600
youngs_modulus = 7e10
yield_stress = 1.5e8
[striker]
mass = 0.2
nose_radius = 0.01
velocity = 15
[model]
segments = 21
[time]
end = 1e-4
)";

constexpr const char* extreme_numbers[] = {
    "0.0",   "-0.0",  "4.9e-324", "1e-308",   "1e-300", "1e-200", "1e-100", "1e-59",
    "1e-40", "1e-30", "1e-20",    "1e-12",    "1e-6",   "1e-3",   "0.5",    "1.0",
    "2.0",   "1e3",   "1e6",      "1e12",     "1e20",   "1e30",   "1e40",   "1e59",
    "1e100", "1e200", "1e300",    "1e308",    "inf",    "-inf",   "nan",    "-1.0",
    "1e-14", "0.1",   "0.25",     "0.999999", "1.5e-5", "1.7e308"};
constexpr const char* extreme_counts[] = {
    "0",   "1",    "2",    "3",          "4",
    "5",   "7",    "10",   "21",         "40",
    "61",  "-1",   "1000", "2147483647", "9223372036854775807",
    "1.0", "1e300"};

// A mantissa of two digits and a moderate exponent.
std::string any_number(ByteSource& source) {
  const std::size_t mantissa = source.byte();
  return fmt::format("{}.{}e{}", mantissa % 10, mantissa / 10,
                     static_cast<int>(source.below(40)) - 20);
}

std::string any_choice(const CaseKey& key, ByteSource& source) {
  return '"' + source.one_of(key.choices).name + '"';
}

std::string any_value(const CaseKey& key, ByteSource& source) {
  const auto number = [&] {
    return source.byte() % 2 == 0 ? source.one_of(extreme_numbers) : any_number(source);
  };
  switch (key.type) {
    case KeyType::text:
      return "\"\\u001b[2J `id` {}$@\"";
    case KeyType::number:
      return number();
    case KeyType::count:
      return source.one_of(extreme_counts);
    case KeyType::flag:
      return source.byte() % 2 == 0 ? "true" : "false";
    case KeyType::choice:
      return any_choice(key, source);
    case KeyType::pair: {
      const std::string first = any_choice(key, source);
      return fmt::format("[{}, {}]", first, any_choice(key, source));
    }
    case KeyType::numbers: {
      const std::string first = number();
      return fmt::format("[{}, {}]", first, number());
    }
    case KeyType::placed: {
      const std::string position = number();
      const std::string value = key.choices.empty() ? number() : any_choice(key, source);
      return fmt::format("[{{ position = {}, {} = {} }}]", position, key.quantity(), value);
    }
  }
  return "0";
}

/// Thrown to end a run.
struct Enough {};

struct StepCounter final : Observer {
  void on_step(const RunView&) override {
    if (++n > most_steps) throw Enough();
  }
  int n = 0;
};

// A finer mesh is right but takes long, and so do rows, of which one step may hold millions.
bool is_small(const Case& input) {
  const double interval = input.output.history_interval(input.end_time);
  if (interval > 0.0 && input.end_time > most_rows * interval) return false;
  return input.model.segments <= most_cells && input.model.elements <= most_cells &&
         input.model.layers <= 100;
}

void explain(const LoadedCase& loaded, bool with_cost) {
  resolve(loaded.value);
  loaded.notes();
  doubtful_units(loaded.value);
  if (with_cost) explanation(loaded.value, loaded.given);
}

}  // namespace

void structured_case(Bytes bytes) {
  ByteSource source(bytes);
  static const bool shown =
      std::getenv("SUBIMPACT_FUZZ_SHOW") != nullptr;  // to reproduce a finding
  const bool with_cost = source.byte() % 16 == 0;     // which makes runs
  std::vector<Override> settings = {{"model.elements", "10", "--set"},
                                    {"model.mesh", "cells", "--set"}};
  while (!source.at_end()) {
    const CaseKey& key = source.one_of(case_keys());
    settings.push_back({key.name, any_value(key, source), "--set"});
    if (shown) fmt::print(stderr, "--set '{}={}'\n", key.name, settings.back().value);
  }
  try {
    const LoadedCase loaded = read_case_text(base, "case.toml", settings);
    if (!is_small(loaded.value)) return;
    try {
      explain(loaded, with_cost);
      StepCounter counter;
      const Result result = simulate(loaded.value, counter);
      summary_json(loaded.value, result);
      run_summary(loaded.value, result);
      sub_impact_table(result);
    } catch (const InvalidCase& error) {
      loaded.message(error);
    }
  } catch (const CaseFileError&) {
  } catch (const Enough&) {
  }
}

}  // namespace subimpact::fuzz
