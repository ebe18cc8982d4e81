// What derivatives of event times are compared with: the table measured beforehand, identities of
// scale, constructed merges, tighter differences, and the cost of one run.

#include "predictability/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "case/shifted_case.h"
#include "draws.h"
#include "predictability/support.h"
#include "study/parallel.h"
#include "subimpact/study/judgement/match.h"
#include "subimpact/study/sensitivity/sensitivity.h"

namespace subimpact::predictability {
namespace {

constexpr double us = 1e6;  // per second

std::optional<Derivative> derivative(const Sensitivity& study, EventQuantity quantity,
                                     std::size_t sub_impact, const std::string& key) {
  const SensitivityRow* row = study.find(quantity, sub_impact);
  for (std::size_t k = 0; row != nullptr && k < study.keys.size(); ++k) {
    if (study.keys[k] == key) return row->by_key[k];
  }
  return std::nullopt;
}

bool verdict(const char* claim, bool holds) {
  fmt::print("\n{}: {}\n", claim, holds ? "holds" : "FAILS");
  std::fflush(stdout);
  return holds;
}

// --- the table
// ------------------------------------------------------------------------------------

struct Measured {
  int sub_impact;                            // from 1
  double end;                                // us
  double velocity, yield_stress, thickness;  // us
  double tolerance;
};

// Central differences at rtol 1e-12, 501 cells, by hand.
constexpr Measured elastic_rows[] = {{1, 218.94, 1.654, -9.316, -142.9, 0.01},
                                     {9, 823.85, -7.219, 2.529, -709.5, 0.01},
                                     {21, 5933.42, -971.6, 1490.0, -7345.0, 0.01},
                                     {26, 6245.58, 51.78, -91.2, -5391.0, 0.01}};
constexpr Measured exact_rows[] = {
    {1, 217.11, -1.215, -4.548, -148.5, 0.01},  {9, 1412.54, -49.8, 40.9, -1263.0, 0.01},
    {16, 1749.05, -128.6, 98.3, -1465.0, 0.01}, {17, 5327.68, -2.66e3, 2.16e3, -1.14e3, 0.05},
    {41, 6435.13, -8.9e3, 7.1e3, 6.6e3, 0.05},  {49, 6910.99, -1.28e4, 1.03e4, 9.5e3, 0.05}};

bool agree_with(const Sensitivity& study, std::span<const Measured> rows, const char* section) {
  bool all = true;
  for (const Measured& row : rows) {
    const auto number = static_cast<std::size_t>(row.sub_impact - 1);
    const SensitivityRow* found = study.find(EventQuantity::end, number);
    const double end = found != nullptr ? us * found->value : 0.0;
    fmt::print("| {} {} | {:.2f} ", section, row.sub_impact, end);
    all = all && std::abs(end - row.end) < 0.01;
    for (const auto& [key, expected] : {std::pair("striker.velocity", row.velocity),
                                        {"beam.yield_stress", row.yield_stress},
                                        {"beam.thickness", row.thickness}}) {
      const auto d = derivative(study, EventQuantity::end, number, key);
      const double off = d ? us * d->value / expected - 1.0 : infinity;
      all = all && std::abs(off) < row.tolerance;
      fmt::print("| {:.5g} ± {:.1g} ({:+.2f} %) ", d ? us * d->value : NAN, d ? us * d->error : NAN,
                 100.0 * off);
    }
    fmt::print("| {} |\n", found != nullptr ? found->flag : "missing");
  }
  return all;
}

}  // namespace

bool check_table(Jobs jobs) {
  fmt::print(
      "| | end, us | velocity | yield stress | thickness | flag |\n|---|---|---|---|---|---|\n");
  SensitivityOptions options{
      {"striker.velocity", "beam.yield_stress", "beam.thickness"}, jobs, {}, {}};
  const bool elastic =
      agree_with(sensitivity(paper_strike(SectionKind::elastic), options), elastic_rows, "elastic");
  const bool exact =
      agree_with(sensitivity(paper_strike(SectionKind::exact), options), exact_rows, "exact");
  return verdict("derivatives measured by hand, within 1 % (zone 2 of the yielding beam: 5 %)",
                 elastic && exact);
}

// --- identities
// -----------------------------------------------------------------------------------

namespace {

constexpr double tolerated_defect = 1e-4;  // of t

/// The defects of the identities over the unflagged starts and ends of zone 1, as shares of t.
struct Defects {
  double time = 0.0, mass = 0.0, length = 0.0;  // the largest
  int n = 0, n_above = 0, n_above_stated = 0;   // times; above what is tolerated, stated errors

  void add(const Defects& other) {
    n += other.n;
    n_above += other.n_above;
    n_above_stated += other.n_above_stated;
  }
};

void add_time(Defects& defects, const Sensitivity& study, const SensitivityRow& row) {
  const double t = row.value;
  double stated = 0.0;
  const auto by = [&](const char* key) {
    const auto d = derivative(study, row.quantity, row.sub_impact, key);
    stated += d ? d->error / t : 0.0;
    return d ? d->value / t : 0.0;
  };
  const double moduli = by("beam.youngs_modulus") + by("beam.yield_stress");
  const double time = std::abs(2.0 * moduli + by("striker.velocity") + 1.0);
  const double mass = std::abs(by("beam.density") + by("striker.mass") + moduli);
  const double length = std::abs(by("beam.length") + by("beam.width") + by("beam.thickness") +
                                 by("striker.nose_radius") + 3.0 * by("striker.mass") - 1.0);
  const double largest = std::max({time, mass, length});
  defects.time = std::max(defects.time, time);
  defects.mass = std::max(defects.mass, mass);
  defects.length = std::max(defects.length, length);
  ++defects.n;
  defects.n_above += largest > tolerated_defect ? 1 : 0;
  defects.n_above_stated += largest > stated ? 1 : 0;
}

Defects defects_of(const Sensitivity& study) {
  Defects defects;
  for (const SensitivityRow& row : study.rows) {
    const bool is_time = row.quantity == EventQuantity::start || row.quantity == EventQuantity::end;
    if (study.base.sub_impacts[row.sub_impact].zone > 1) break;
    if (is_time && row.value > 0.0 && row.flag.empty()) add_time(defects, study, row);
  }
  return defects;
}

}  // namespace

bool check_identities(Jobs jobs) {
  fmt::print(
      "| scene | section | theory | times | above 1e-4 | above stated errors | time | mass | "
      "length "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  Defects all;
  for (int number = 0; number < 10; ++number) {
    for (const SectionKind section : {SectionKind::elastic, SectionKind::exact}) {
      for (const auto& [theory, name] : {std::pair(BeamTheory::rayleigh, "rayleigh"),
                                         {BeamTheory::euler_bernoulli, "euler-bernoulli"},
                                         {BeamTheory::timoshenko, "timoshenko"}}) {
        const Sensitivity study =
            sensitivity(random_strike(number, section, theory), {{}, jobs, {}, {}});
        const Defects d = defects_of(study);
        all.add(d);
        fmt::print("| {} | {} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} |\n", number,
                   section == SectionKind::elastic ? "elastic" : "exact", name, d.n, d.n_above,
                   d.n_above_stated, d.time, d.mass, d.length);
        std::fflush(stdout);
      }
    }
  }
  fmt::print("\n{} times; {:.1f} % within 1e-4 of t, {:.1f} % within their stated errors\n", all.n,
             100.0 * (all.n - all.n_above) / std::max(all.n, 1),
             100.0 * (all.n - all.n_above_stated) / std::max(all.n, 1));
  return verdict("identities of time, mass and length, to 1e-4 of t in zone 1",
                 all.n > 0 && all.n_above == 0);
}

// --- merges
// ---------------------------------------------------------------------------------------

namespace {

Case at_velocity(Case input, double velocity) {
  input.scene.striker.velocity = velocity;
  return input;
}

constexpr double counted_part = 0.9;  // of the run: sub-impacts that begin in it

std::size_t count_of(const Case& input) {
  const Result result = simulate(input);
  return static_cast<std::size_t>(std::ranges::count_if(
      result.sub_impacts,
      [&](const SubImpact& s) { return s.start < counted_part * input.end_time; }));
}

bool starts_at(const Case& input, double time) {
  return std::ranges::any_of(simulate(input).sub_impacts, [&](const SubImpact& s) {
    return std::abs(s.start / time - 1.0) < 1e-6;
  });
}

// The velocity between two of different counts at which the count changes, to rounding.
double edge_between(const Case& input, double low, double high) {
  const std::size_t n = count_of(at_velocity(input, low));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (count_of(at_velocity(input, middle)) == n ? low : high) = middle;
  }
  return low;
}

// The first velocity above that of the case at which contacts merge, split, appear or vanish.
double edge_above(const Case& input) {
  double v = input.scene.striker.velocity;
  for (;;) {
    const double last = v;
    const std::size_t n = count_of(at_velocity(input, v));
    while (count_of(at_velocity(input, v)) == n) v *= 1.01;
    const double edge = edge_between(input, std::max(last, v / 1.01), v);
    // Not a contact that moves across the limit of what is counted.
    if (!starts_at(at_velocity(input, edge), counted_part * input.end_time)) return edge;
  }
}

}  // namespace

bool check_merges(Jobs jobs) {
  constexpr int n_cases = 20;
  Random random(17);
  int n_flagged = 0;
  fmt::print("| scene | edge, m/s | distance | contacts | flagged |\n|---|---|---|---|---|\n");
  for (int number = 0; number < n_cases; ++number) {
    Case input =
        sensitivity_case(random_strike(number, SectionKind::elastic, BeamTheory::rayleigh));
    const double edge = edge_above(input);
    const double distance = random.uniform(-0.9, 0.9) * sensitivity_shifts[0];
    input.scene.striker.velocity = edge * (1.0 + distance);
    const Sensitivity study = sensitivity(input, {{"striker.velocity"}, jobs, {}, {}});
    std::string flags;
    for (const SensitivityRow& row : study.rows) {
      if (row.quantity == EventQuantity::end && !row.flag.empty()) {
        flags += fmt::format("{}: {}; ", row.sub_impact + 1, row.flag);
      }
    }
    n_flagged += flags.empty() ? 0 : 1;
    fmt::print("| {} | {:.12g} | {:+.1e} | {} | {} |\n", number, edge, distance,
               study.base.sub_impacts.size(), flags);
    std::fflush(stdout);
  }
  fmt::print("\n{} of {} flagged", n_flagged, n_cases);
  return verdict("a change of contacts within the shift is flagged", n_flagged == n_cases);
}

// --- coverage
// -------------------------------------------------------------------------------------

namespace {

// By runs at a far tighter tolerance, of fourth order in the shift, and the difference between its
// two shifts; nothing where a run lacks the sub-impact.
class TightDifferences {
 public:
  TightDifferences(const Sensitivity& study, const std::string& key) : base_(study.base) {
    Case input = study.input;
    input.solver.rtol = 1e-14;
    for (const double factor : {1.0, -1.0, 2.0, -2.0}) {
      runs_.push_back(simulate(shifted(input, *find_case_key(key), factor * shift)));
      found_.push_back(counterparts(base_.sub_impacts, runs_.back().sub_impacts));
    }
  }
  // Counterparts point into the runs.
  TightDifferences(const TightDifferences&) = delete;
  TightDifferences& operator=(const TightDifferences&) = delete;

  std::optional<Derivative> of(EventQuantity quantity, std::size_t i) const {
    std::array<double, 4> f{};
    for (std::size_t k = 0; k < f.size(); ++k) {
      const SubImpact* s = found_[k].of[i];
      if (s == nullptr || !s->end) return std::nullopt;
      f[k] = *value_of(*s, quantity);
    }
    const double near = (f[0] - f[1]) / (2.0 * shift), far = (f[2] - f[3]) / (4.0 * shift);
    return Derivative{near + (near - far) / 3.0, std::abs(near - far)};
  }

 private:
  static constexpr double shift = 5e-6;
  const Result& base_;
  std::vector<Result> runs_;
  std::vector<Counterparts> found_;
};

struct Coverage {
  int n = 0, n_covered = 0;
  std::vector<double> ratios;  // stated over true

  void add(double stated, double off) {
    ++n;
    n_covered += off <= stated ? 1 : 0;
    if (off > 0.0) ratios.push_back(stated / off);
  }
  double median() {
    std::sort(ratios.begin(), ratios.end());
    return ratios.empty() ? 0.0 : ratios[ratios.size() / 2];
  }
};

}  // namespace

bool check_coverage(Jobs jobs) {
  constexpr int n_scenes = 8;
  Coverage total;
  std::array<Coverage, event_quantities.size()> by_quantity;
  for (const SectionKind section : {SectionKind::elastic, SectionKind::exact}) {
    for (int number = 0; number < n_scenes; ++number) {
      const Sensitivity study =
          sensitivity(random_strike(number, section, BeamTheory::rayleigh), {{}, jobs, {}, {}});
      Coverage here;
      int n_unjudged = 0;
      std::mutex mutex;
      in_parallel(study.keys.size(), jobs, [&](std::size_t k) {
        const TightDifferences tight(study, study.keys[k]);
        const std::lock_guard lock(mutex);
        for (const SensitivityRow& row : study.rows) {
          if (row.value == 0.0 || !row.flag.empty() || !row.by_key[k]) continue;
          const auto exact = tight.of(row.quantity, row.sub_impact);
          if (!exact || exact->error > 0.3 * row.by_key[k]->error) {
            ++n_unjudged;
            continue;
          }
          const double off = std::abs(row.by_key[k]->value - exact->value);
          for (Coverage* c :
               {&total, &here, &by_quantity[static_cast<std::size_t>(row.quantity)]}) {
            c->add(row.by_key[k]->error, off);
          }
        }
      });
      fmt::print(
          "scene {} {}: {} contacts, {} derivatives, {:.1f} % covered, stated/true {:.1f}; {} more "
          "without a better difference\n",
          number, section == SectionKind::elastic ? "elastic" : "exact",
          study.base.sub_impacts.size(), here.n, 100.0 * here.n_covered / std::max(here.n, 1),
          here.median(), n_unjudged);
      std::fflush(stdout);
    }
  }
  fmt::print("\n| quantity | derivatives | covered | median stated/true |\n|---|---|---|---|\n");
  for (const EventQuantity quantity : event_quantities) {
    Coverage& c = by_quantity[static_cast<std::size_t>(quantity)];
    fmt::print("| {} | {} | {:.1f} % | {:.1f} |\n", to_string(quantity), c.n,
               100.0 * c.n_covered / std::max(c.n, 1), c.median());
  }
  fmt::print("| all | {} | {:.1f} % | {:.1f} |\n", total.n,
             100.0 * total.n_covered / std::max(total.n, 1), total.median());
  return verdict("stated errors cover at least 95 % of at least 500 derivatives",
                 total.n >= 500 && total.n_covered >= 0.95 * total.n);
}

// --- cost
// -----------------------------------------------------------------------------------------

bool check_cost(Jobs jobs) {
  const auto seconds_of = [](const auto& task) {
    const std::clock_t before = std::clock();
    task();
    return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  };
  const Case input = paper_strike(SectionKind::exact);
  const Case base = sensitivity_case(input);
  std::vector<double> ratios;
  for (int i = 0; i < 3; ++i) {
    const double before = seconds_of([&] { simulate(base); });
    const double study = seconds_of([&] { sensitivity(input, {{}, jobs, {}, {}}); });
    const double after = seconds_of([&] { simulate(base); });
    ratios.push_back(2.0 * study / (before + after));
    fmt::print("one run {:.2f} and {:.2f} s, nine keys {:.1f} s: {:.2f} runs\n", before, after,
               study, ratios.back());
    std::fflush(stdout);
  }
  std::sort(ratios.begin(), ratios.end());
  return verdict("nine keys take less than 40 times the processor time of one run",
                 ratios[1] < 40.0);
}

}  // namespace subimpact::predictability
