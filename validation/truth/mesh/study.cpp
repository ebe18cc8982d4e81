// What the mesh costs and what it leaves wrong: cells and Hermite elements on the paper's example,
// elastic and yielding. Writes convergence.csv and the figure beside this file.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"

namespace {

using namespace subimpact;

constexpr double us = 1e6;
constexpr double horizon = 0.84e-3;  // s: sub-impacts 1 to 9 of the elastic beam

// Kinds of meshes side by side.
enum class Kind { cells, elements };

struct KindName {
  Kind kind;
  const char* name;
};
constexpr KindName kinds[] = {
    {Kind::cells, "cells"},
    {Kind::elements, "elements"},
};

const char* name_of(Kind kind) {
  for (const KindName& k : kinds) {
    if (k.kind == kind) return k.name;
  }
  return "";
}

Case example(Kind kind, int count, SectionKind section, double end_time) {
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
  input.model.mesh = kind == Kind::cells ? MeshKind::cells : MeshKind::hermite;
  (kind == Kind::cells ? input.model.segments : input.model.elements) = count;
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
  double error, median, first_error, seconds;  // s
};

std::vector<Point> converge(SectionKind section, const std::vector<SubImpact>& limit) {
  std::vector<Point> points;
  const char* name = section == SectionKind::elastic ? "elastic" : "exact";
  const auto add = [&](Kind kind, int count) {
    const auto start = std::chrono::steady_clock::now();
    const Result result = simulate(example(kind, count, section, horizon));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const EventErrors errors = event_errors(result.sub_impacts, limit);
    points.push_back({name, name_of(kind), count, result.used.n_unknowns, errors.overall(),
                      errors.median, errors.first, taken.count()});
    const Point& p = points.back();
    fmt::print("{:8} {:15} {:6} {:6} {:12.3e} {:12.3e} {:12.3e} {:10.3f}\n", p.section, p.mesh,
               p.count, p.unknowns, p.error * us, p.median * us, p.first_error * us, p.seconds);
    std::fflush(stdout);
  };
  for (const int n : {251, 501, 1001, 1415, 2001, 2829}) add(Kind::cells, n);
  const bool elastic = section == SectionKind::elastic;
  for (const int n : {70, 100, 140, 200, 280, 400, 566, 800}) {
    if (elastic && n > 400) break;  // the limit's own error shows
    add(Kind::elements, n);
  }
  return points;
}

std::vector<SubImpact> elastic_limit() {
  Case finest = example(Kind::elements, 800, SectionKind::elastic, horizon);
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
    for (const KindName& kind : kinds) {
      const auto found = needed(points, kind.name, wanted);
      fmt::print("{:8} within {:.1f} us: {:15} {}\n", points.front().section, wanted * us,
                 kind.name,
                 found ? fmt::format("{:.0f} unknowns, {:.2f} s", found->first, found->second)
                       : std::string("not reached"));
    }
  }
}

// --- output -------------------------------------------------------------------------------------

void write_points(const std::string& directory, const std::vector<Point>& points) {
  std::ofstream csv(directory + "/convergence.csv");
  csv << "section,mesh,count,unknowns,max_error_us,median_error_us,"
         "first_separation_error_us,wall_s\n";
  for (const Point& p : points) {
    csv << fmt::format("{},{},{},{},{:.4e},{:.4e},{:.4e},{:.4f}\n", p.section, p.mesh, p.count,
                       p.unknowns, p.error * us, p.median * us, p.first_error * us, p.seconds);
  }
}

}  // namespace

int main() {
  const std::string directory = SUBIMPACT_MESH_STUDY;
  fmt::print(
      "errors of starts and ends before {:.2f} ms, nystrom at rtol 1e-9\n\n"
      "{:8} {:15} {:>6} {:>6} {:>12} {:>12} {:>12} {:>10}\n",
      1e3 * horizon, "section", "mesh", "count", "unkn.", "largest, us", "median, us", "first, us",
      "wall, s");
  std::vector<Point> points = converge(SectionKind::elastic, elastic_limit());
  const Result coarse = simulate(example(Kind::cells, 4003, SectionKind::exact, horizon));
  const Result fine = simulate(example(Kind::cells, 8007, SectionKind::exact, horizon));
  const std::vector<Point> yielding = converge(SectionKind::exact, limit_of(coarse, fine));
  fmt::print("\n");
  print_needed(points);
  print_needed(yielding);
  points.insert(points.end(), yielding.begin(), yielding.end());
  write_points(directory, points);
}
