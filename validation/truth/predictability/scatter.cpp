// The published strike under scatter: standard deviations and horizon by first derivatives, beside
// an ensemble of runs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "predictability/checks.h"
#include "predictability/ensemble.h"
#include "predictability/support.h"

namespace subimpact::predictability {
namespace {

constexpr double us = 1e6;  // per second
constexpr double ms = 1e3;
constexpr std::size_t n_runs = 2000;
constexpr double share_that_ends = 0.05;  // of runs in which a contact changes

const char* name_of(SectionKind section) {
  return section == SectionKind::elastic ? "elastic" : "yielding";
}

struct Study {
  SectionKind section;
  double scatter;
  Sensitivity sensitivity;
  Result result;  // with predictability
  Ensemble ensemble;
};

Scatter all_by(double deviation) {
  return {{"striker.velocity", deviation},
          {"beam.thickness", deviation},
          {"beam.yield_stress", deviation}};
}

Study study_of(SectionKind section, double deviation, Jobs jobs) {
  Study study{section, deviation, {}, {}, {}};
  const Scatter scatter = all_by(deviation);
  SensitivityOptions options;
  for (const auto& [key, unused] : scatter) options.keys.push_back(key);
  options.jobs = jobs;
  study.sensitivity = sensitivity(paper_strike(section), options);
  study.result = study.sensitivity.base;
  set_predictability(study.result, study.sensitivity, scatter);
  study.sensitivity.input.solver.rtol = 1e-8;  // errors of 1e-5 us
  EnsembleOptions how;
  how.n_runs = n_runs;
  how.jobs = jobs;
  study.ensemble = ensemble(study.sensitivity, scatter, how);
  return study;
}

/// What an ensemble says of a horizon by first derivatives.
struct Judged {
  std::size_t n_unchanged = 0;   // leading sub-impacts that every run has
  std::size_t first_ending = 0;  // the first that changes in more than 5 % of the runs
  std::size_t horizon = 0;       // sub-impacts before the horizon
  double largest_off = 0.0;      // of standard deviations of the leading ones, relative
};

Judged judge(const Study& study) {
  Judged judged;
  const auto& events = study.ensemble.events;
  const std::size_t n = events.size();
  const auto n_all = static_cast<double>(study.ensemble.runs.size());
  while (judged.n_unchanged < n && events[judged.n_unchanged].n_changed_so_far == 0) {
    ++judged.n_unchanged;
  }
  while (judged.first_ending < n &&
         static_cast<double>(events[judged.first_ending].n_changed) <= share_that_ends * n_all) {
    ++judged.first_ending;
  }
  judged.horizon = study.result.predictability->first_unpredictable.value_or(n);
  for (std::size_t i = 0; i < judged.n_unchanged; ++i) {
    const SubImpact& s = study.result.sub_impacts[i];
    if (i > 0) {
      judged.largest_off = std::max(judged.largest_off,
                                    std::abs(*s.start_scatter / events[i].start_deviation - 1.0));
    }
    if (s.end) {
      judged.largest_off =
          std::max(judged.largest_off, std::abs(*s.end_scatter / events[i].end_deviation - 1.0));
    }
  }
  return judged;
}

void print_events(const Study& study) {
  fmt::print(
      "\n| no. | start, us | by derivatives | ensemble | end, us | by derivatives | ensemble | "
      "runs "
      "that have it |\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < study.ensemble.events.size(); ++i) {
    const SubImpact& s = study.result.sub_impacts[i];
    const EnsembleEvent& e = study.ensemble.events[i];
    const auto cell = [](const std::optional<double>& x) {
      return x ? fmt::format("{:.3g}", us * *x) : std::string("-");
    };
    fmt::print(
        "| {} | {:.2f} | {} | {:.3g} | {:.2f} | {} | {:.3g} | {:.1f} % |\n", i + 1, us * s.start,
        cell(s.start_scatter), us * e.start_deviation, us * s.end.value_or(NAN),
        cell(s.end_scatter), us * e.end_deviation,
        100.0 * static_cast<double>(e.n_present) / static_cast<double>(study.ensemble.runs.size()));
  }
}

// The share of the runs that are in contact, at equal times, the contacts of the strike as given,
// and the horizon with the number of contacts up to it; times in ms.
void write_rows(std::ofstream& csv, const Study& study) {
  constexpr int n = 4000;
  const Predictability& p = *study.result.predictability;
  const std::string title =
      fmt::format("{} sections; {} runs, velocity, thickness and yield stress known to {:g} %",
                  name_of(study.section), study.ensemble.runs.size(), 100.0 * study.scatter);
  const auto write = [&](const char* what, double x, double y) {
    csv << fmt::format("\"{}\",{},{:.6g},{:.6g}\n", title, what, x, y);
  };
  const double end = study.result.outcome.time;
  std::vector<int> steps(n + 1, 0);  // changes of the number in contact
  const auto index = [&](double t) {
    return static_cast<std::size_t>(std::clamp(t / end * n, 0.0, static_cast<double>(n)));
  };
  for (const Result& run : study.ensemble.runs) {
    for (const SubImpact& s : run.sub_impacts) {
      ++steps[index(s.start)];
      --steps[index(run.end_of(s))];
    }
  }
  int in_contact = 0;
  for (int i = 0; i < n; ++i) {
    in_contact += steps[static_cast<std::size_t>(i)];
    write("share", ms * end * i / n,
          100.0 * in_contact / static_cast<double>(study.ensemble.runs.size()));
  }
  const std::vector<SubImpact>& contacts = study.result.sub_impacts;
  for (const SubImpact& s : contacts) write("contact", ms * s.start, ms * study.result.end_of(s));
  write("horizon", ms * p.horizon,
        static_cast<double>(p.first_unpredictable.value_or(contacts.size())));
}

}  // namespace

bool check_scatter(Jobs jobs) {
  bool all = true;
  std::ofstream csv("scatter.csv");
  csv << "title,what,x,y\n";
  for (const SectionKind section : {SectionKind::elastic, SectionKind::exact}) {
    for (const double deviation : {1e-2, 1e-3}) {
      const Study study = study_of(section, deviation, jobs);
      const Judged judged = judge(study);
      const Predictability& p = *study.result.predictability;
      fmt::print("\n### {} sections, {:g} %\n\n", name_of(section), 100.0 * deviation);
      fmt::print(
          "{} runs, {} failed. Every run has the first {} sub-impacts as they are; by derivatives "
          "their standard deviations are off by {:.1f} % at most. Number {} is the first that "
          "changes in more than 5 % of the runs.\nPredicted: {} sub-impacts, to {:.1f} us; beyond: "
          "{}.\n",
          study.ensemble.runs.size(), study.ensemble.n_failed, judged.n_unchanged,
          100.0 * judged.largest_off, judged.first_ending + 1, judged.horizon, us * p.horizon,
          p.reason);
      for (std::size_t z = 0; z < p.zones.size(); ++z) {
        const auto& zone = p.zones[z];
        fmt::print("zone {}: start {:.2g} us, end {:.2g} us, impulse {:.2g} N s\n", z + 1,
                   us * zone.start_scatter.value_or(NAN), us * zone.end_scatter.value_or(NAN),
                   zone.impulse_scatter.value_or(NAN));
      }
      print_events(study);
      std::fflush(stdout);
      all = all && judged.largest_off < 0.1 && judged.horizon <= judged.first_ending;
      write_rows(csv, study);
    }
  }
  fmt::print(
      "\nstandard deviations within 10 %, no horizon beyond a contact that changes in more than "
      "5 %: {}\n",
      all ? "holds" : "FAILS");
  return all;
}

}  // namespace subimpact::predictability
