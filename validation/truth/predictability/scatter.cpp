// The published strike under scatter: standard deviations and horizon by first derivatives, beside
// an ensemble of runs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "predictability/checks.h"
#include "predictability/ensemble.h"
#include "predictability/support.h"
#include "report/figures/gnuplot.h"
#include "report/files.h"

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

// The share of the runs that are in contact, at equal times.
std::string contact_table(const Study& study, double end) {
  constexpr int n = 4000;
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
  std::string text;
  int in_contact = 0;
  for (int i = 0; i < n; ++i) {
    in_contact += steps[static_cast<std::size_t>(i)];
    text += fmt::format("{:.5g} {:.4g}\n", ms * end * i / n,
                        100.0 * in_contact / static_cast<double>(study.ensemble.runs.size()));
  }
  return text;
}

// Blue: the share of runs in contact. Black, above: the contacts of the strike as given.
std::string panel(const Study& study, const std::string& name) {
  const Predictability& p = *study.result.predictability;
  const auto& contacts = study.result.sub_impacts;
  std::string text = "unset object\nunset arrow\nunset label\n";
  int number = 0;
  for (const SubImpact& s : contacts) {
    text += fmt::format(
        "set object {} rectangle from first {:.6g}, graph 1.03 to first {:.6g}, graph 1.11 noclip "
        "fillcolor rgb '#404040' fillstyle solid noborder\n",
        ++number, ms * s.start, ms * study.result.end_of(s));
  }
  text += fmt::format(
      "set arrow 1 from first {0:.6g}, graph 0 to first {0:.6g}, graph 1.14 nohead lt 2 lw 3 "
      "front\n"
      "set title '{6} sections; velocity, thickness and yield stress known to {1:g} %' offset "
      "0,0.8\n"
      "set label 1 'grey, above: contacts of the strike as given' at graph 0.26, graph 0.85\n"
      "set label 2 'blue: share of {2} runs that are in contact' at graph 0.26, graph 0.71\n"
      "set label 3 'orange: predictable one by one up to here, {3} of {4} contacts' at graph 0.26, "
      "graph 0.57 tc lt 2\n"
      "plot ${5} using 1:2 with filledcurves y1=0 lc rgb '#56B4E9' notitle\n",
      ms * p.horizon, 100.0 * study.scatter, study.ensemble.runs.size(),
      p.first_unpredictable.value_or(contacts.size()), contacts.size(), name,
      name_of(study.section));
  return text;
}

void draw(const std::vector<Study>& studies) {
  std::string script(embedded_file("figures/style.gp"));
  const double end = studies.front().result.outcome.time;
  std::string panels;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const std::string name = fmt::format("contact{}", i);
    script += fmt::format("${} << EOD\n{}EOD\n", name, contact_table(studies[i], end));
    panels += panel(studies[i], name);
  }
  script += fmt::format(
      "set xrange [0:{:g}]\nset yrange [0:100]\nset ylabel 'in contact, % of runs'\n"
      "set xlabel 'time, ms'\nset multiplot layout {},1 spacing 0.1,0.07\n{}unset multiplot\n",
      ms * end, studies.size(), panels);
  const std::filesystem::path directory = SUBIMPACT_PREDICTABILITY;
  draw_figure(directory, "scatter", script, {1100, 1150});
  for (const char* other : {"scatter.gp", "scatter.svg", "scatter.pdf"}) {
    std::filesystem::remove(directory / other);
  }
}

}  // namespace

bool check_scatter(Jobs jobs) {
  bool all = true;
  std::vector<Study> drawn;
  for (const SectionKind section : {SectionKind::elastic, SectionKind::exact}) {
    for (const double deviation : {1e-2, 1e-3}) {
      Study study = study_of(section, deviation, jobs);
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
      drawn.push_back(std::move(study));
    }
  }
  draw(drawn);
  fmt::print(
      "\nstandard deviations within 10 %, no horizon beyond a contact that changes in more than "
      "5 %: {}\n",
      all ? "holds" : "FAILS");
  return all;
}

}  // namespace subimpact::predictability
