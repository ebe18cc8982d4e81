// What the mesh costs and what it leaves wrong: cells and Hermite elements on the paper's example,
// elastic and yielding. Writes convergence.csv, limits.csv and the figure beside this file.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "io/gnuplot.h"
#include "subimpact/simulate/simulate.h"
#include "subimpact/study/event_errors.h"
#include "subimpact/study/mesh_error_bars.h"

namespace {

using namespace subimpact;

constexpr double us = 1e6;
constexpr double horizon = 0.84e-3;  // s: sub-impacts 1 to 9 of the elastic beam

Case example(MeshKind mesh, int count, SectionKind section, double end_time) {
  Case input;
  input.scene.beam = {.length = 0.7112,
                      .width = 0.0163,
                      .thickness = 0.0075,
                      .density = 2600.0,
                      .youngs_modulus = 71.96e9,
                      .yield_stress = 150e6};
  input.scene.striker.mass = 0.201;
  input.scene.striker.nose_radius = 0.01;
  input.scene.striker.velocity = 15.9;
  input.model.mesh = mesh;
  (mesh == MeshKind::cells ? input.model.segments : input.model.elements) = count;
  input.model.section = section;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-9;
  input.output.interval = 0.0;
  input.end_time = end_time;
  return input;
}

// t* = t_fine + (t_fine - t_coarse)/(r^2 - 1), for cells.
double extrapolated(double coarse, double fine) { return fine + (fine - coarse) / 3.0; }

// --- error over unknowns ------------------------------------------------------------------------

struct Point {
  std::string section, mesh;
  int count;
  std::size_t unknowns;
  double error, first_error, seconds;  // s
};

std::vector<Point> converge(SectionKind section, const std::vector<SubImpact>& limit) {
  std::vector<Point> points;
  const char* name = section == SectionKind::elastic ? "elastic" : "exact";
  const auto add = [&](MeshKind mesh, int count) {
    const auto start = std::chrono::steady_clock::now();
    const Result result = simulate(example(mesh, count, section, horizon));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const EventErrors errors = event_errors(result.sub_impacts, limit);
    points.push_back({name, mesh == MeshKind::cells ? "cells" : "hermite", count,
                      result.used.n_unknowns, errors.overall(), errors.first, taken.count()});
    const Point& p = points.back();
    fmt::print("{:8} {:8} {:6} {:6} {:12.3e} {:12.3e} {:10.3f}\n", p.section, p.mesh, p.count,
               p.unknowns, p.error * us, p.first_error * us, p.seconds);
    std::fflush(stdout);
  };
  for (const int n : {251, 501, 1001, 1415, 2001, 2829}) add(MeshKind::cells, n);
  for (const int n : {100, 140, 200, 280, 400, 566, 800}) {
    if (section == SectionKind::elastic && n > 400) break;  // the limit's own error shows
    add(MeshKind::hermite, n);
  }
  return points;
}

std::vector<SubImpact> elastic_limit() {
  Case finest = example(MeshKind::hermite, 800, SectionKind::elastic, horizon);
  finest.solver.method = Method::exponential;
  finest.solver.rtol = 1e-11;
  return simulate(finest).sub_impacts;
}

// Extrapolated from two runs on cells.
std::vector<SubImpact> limit_of(const Result& coarse, const Result& fine) {
  std::vector<SubImpact> limit = fine.sub_impacts;
  for (std::size_t i = 0; i < std::min(limit.size(), coarse.sub_impacts.size()); ++i) {
    const SubImpact& below = coarse.sub_impacts[i];
    limit[i].start = extrapolated(below.start, limit[i].start);
    if (limit[i].end && below.end) limit[i].end = extrapolated(*below.end, *limit[i].end);
  }
  return limit;
}

// Unknowns and seconds at which a mesh comes within `wanted`, interpolated in the logarithms.
std::optional<std::pair<double, double>> needed(const std::vector<Point>& points,
                                                const std::string& mesh, double wanted) {
  const Point* before = nullptr;
  for (const Point& p : points) {
    if (p.mesh != mesh) continue;
    if (p.error <= wanted) {
      if (before == nullptr) return {{static_cast<double>(p.unknowns), p.seconds}};
      const double share = std::log(before->error / wanted) / std::log(before->error / p.error);
      const auto between = [&](double a, double b) { return a * std::pow(b / a, share); };
      return {{between(static_cast<double>(before->unknowns), static_cast<double>(p.unknowns)),
               between(before->seconds, p.seconds)}};
    }
    before = &p;
  }
  return std::nullopt;
}

void print_needed(const std::vector<Point>& points) {
  for (const double wanted : {1e-6, 1e-7}) {
    for (const char* mesh : {"cells", "hermite"}) {
      const auto found = needed(points, mesh, wanted);
      fmt::print("{:8} within {:.1f} us: {:8} {}\n", points.front().section, wanted * us, mesh,
                 found ? fmt::format("{:.0f} unknowns, {:.2f} s", found->first, found->second)
                       : std::string("not reached"));
    }
  }
}

// --- limits of the yielding example -------------------------------------------------------------

struct Quantity {
  const char* name;
  std::optional<double> (*of)(const Result&);
};

const SubImpact* zone_edge(const Result& result, int zone, bool last) {
  const SubImpact* found = nullptr;
  for (const SubImpact& s : result.sub_impacts) {
    if (s.zone != zone || (found != nullptr && !last)) continue;
    found = &s;
  }
  return found;
}

const Quantity quantities[] = {
    {"first section yields", [](const Result& r) { return r.first_section_yield; }},
    {"contact yields", [](const Result& r) { return r.first_contact_yield; }},
    {"first separation", [](const Result& r) { return r.sub_impacts.front().end; }},
    {"zone 1 ends",
     [](const Result& r) {
       const SubImpact* s = zone_edge(r, 1, true);
       return s ? s->end : std::nullopt;
     }},
    {"zone 2 begins",
     [](const Result& r) {
       const SubImpact* s = zone_edge(r, 2, false);
       return s ? std::optional(s->start) : std::nullopt;
     }},
    {"zone 2 ends",
     [](const Result& r) {
       const SubImpact* s = zone_edge(r, 2, true);
       return s ? s->end : std::nullopt;
     }},
};

void write_limits(const std::string& directory, const std::vector<Result>& runs,
                  const std::vector<int>& counts) {
  std::ofstream csv(directory + "/limits.csv");
  std::string head = "quantity";
  for (const int n : counts) head += fmt::format(",cells_{}_us", n);
  csv << head << ",limit_us,uncertainty_us,differences_ratio\n";
  fmt::print("\nyielding example (section exact), us\n");
  for (const Quantity& quantity : quantities) {
    std::vector<double> t;
    for (const Result& run : runs) t.push_back(quantity.of(run).value_or(NAN) * us);
    const std::size_t n = t.size();
    const double limit = extrapolated(t[n - 2], t[n - 1]);
    const double ratio = (t[n - 3] - t[n - 2]) / (t[n - 2] - t[n - 1]);
    // At a ratio near 4, the order of cells, the extrapolation is trusted to its own size; else to
    // the last two differences.
    const bool orderly = ratio > 2.5 && ratio < 6.5;
    const double doubt =
        orderly ? std::abs(limit - t[n - 1])
                : std::max(std::abs(t[n - 1] - t[n - 2]), std::abs(t[n - 2] - t[n - 3]));
    std::string row = quantity.name;
    for (const double x : t) row += fmt::format(",{:.4f}", x);
    csv << row << fmt::format(",{:.4f},{:.4f},{:.2f}\n", limit, doubt, ratio);
    fmt::print("{:22} {:10.3f} +- {:.3f}   (differences in the ratio {:.1f})\n", quantity.name,
               limit, doubt, ratio);
  }
  std::string impacts;
  for (const Result& run : runs) impacts += fmt::format(" {}", run.sub_impacts.size());
  fmt::print("sub-impacts:{}\n", impacts);
}

// --- output -------------------------------------------------------------------------------------

void write_points(const std::string& directory, const std::vector<Point>& points) {
  std::ofstream csv(directory + "/convergence.csv");
  csv << "section,mesh,count,unknowns,max_error_us,first_separation_error_us,wall_s\n";
  for (const Point& p : points) {
    csv << fmt::format("{},{},{},{},{:.4e},{:.4e},{:.4f}\n", p.section, p.mesh, p.count, p.unknowns,
                       p.error * us, p.first_error * us, p.seconds);
  }
}

void draw(const std::string& directory, const std::vector<Point>& points) {
  std::string script = figure_style();
  const auto block = [&](const std::string& section, const std::string& mesh) {
    script += fmt::format("${}_{} << EOD\n", section, mesh);
    for (const Point& p : points) {
      if (p.section == section && p.mesh == mesh) {
        script += fmt::format("{} {:.6e}\n", p.unknowns, p.error * us);
      }
    }
    script += "EOD\n";
  };
  for (const char* section : {"elastic", "exact"}) {
    for (const char* mesh : {"cells", "hermite"}) block(section, mesh);
  }
  script +=
      "set logscale xy\nset format y '10^{%T}'\nset xlabel 'unknowns of the half model'\n"
      "set ylabel 'largest error of a start or end, us'\nset xrange [40:2000]\n"
      "set yrange [1e-3:2e2]\nset xtics (50, 100, 200, 500, 1000, 2000)\n"
      "set key top right\nset multiplot layout 1,2\n"
      "set title 'elastic sections'\n"
      "plot $elastic_cells using 1:2 with linespoints lw 2 title 'cells', "
      "$elastic_hermite using 1:2 with linespoints lw 2 title 'Hermite elements', "
      "1 with lines dt 2 lc 'grey40' notitle, 0.1 with lines dt 2 lc 'grey40' "
      "notitle\n"
      "set title 'sections that yield (exact)'\n"
      "plot $exact_cells using 1:2 with linespoints lw 2 title 'cells', "
      "$exact_hermite using 1:2 with linespoints lw 2 title 'Hermite elements', "
      "1 with lines dt 2 lc 'grey40' notitle, 0.1 with lines dt 2 lc 'grey40' notitle\n"
      "unset multiplot\n";
  draw_figure(directory, "convergence", script, {1100, 480});
  std::filesystem::remove(directory + "/convergence.gp");  // the study itself is the script
}

}  // namespace

int main() {
  const std::string directory = SUBIMPACT_MESH_STUDY;
  const std::vector<int> counts{1001, 2001, 4001};
  auto behind = std::async(std::launch::async, [&] {
    std::vector<Result> runs;
    for (const int n : counts) {
      runs.push_back(simulate(example(MeshKind::cells, n, SectionKind::exact, 8e-3)));
    }
    return runs;
  });
  fmt::print(
      "errors of starts and ends before {:.2f} ms, nystrom at rtol 1e-9\n\n"
      "{:8} {:8} {:>6} {:>6} {:>12} {:>12} {:>10}\n",
      1e3 * horizon, "section", "mesh", "count", "unkn.", "largest, us", "first, us", "wall, s");
  std::vector<Point> points = converge(SectionKind::elastic, elastic_limit());
  const Result coarse = simulate(example(MeshKind::cells, 2001, SectionKind::exact, horizon));
  const Result fine = simulate(example(MeshKind::cells, 4003, SectionKind::exact, horizon));
  const std::vector<Point> yielding = converge(SectionKind::exact, limit_of(coarse, fine));
  fmt::print("\n");
  print_needed(points);
  print_needed(yielding);
  points.insert(points.end(), yielding.begin(), yielding.end());
  write_points(directory, points);
  draw(directory, points);
  write_limits(directory, behind.get(), counts);
}
