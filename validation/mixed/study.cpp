// Mixed cells and cells, by central differences, on five strikes that yield and an elastic one:
// error over unknowns and over time. Writes convergence.csv and the figure beside this file.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "report/files.h"
#include "report/gnuplot.h"
#include "scenes.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/event_errors.h"

namespace {

using namespace subimpact;

constexpr double us = 1e6;
constexpr int repetitions = 5;  // of each run, of which the fastest counts

struct Strike {
  const char* name;
  double mass, velocity, position;
  std::array<EndSupport, 2> ends;
  SectionKind section;
};
constexpr std::array both_free{EndSupport::free, EndSupport::free};
constexpr Strike strikes[] = {
    {"published", 0.201, 15.9, 0.5, both_free, SectionKind::exact},
    {"elastic", 0.201, 15.9, 0.5, both_free, SectionKind::elastic},
    {"light_fast", 0.05, 30.0, 0.5, both_free, SectionKind::exact},
    {"heavy_slow", 1.0, 6.0, 0.5, both_free, SectionKind::exact},
    {"pinned", 0.201, 15.9, 0.5, {EndSupport::pinned, EndSupport::pinned}, SectionKind::exact},
    {"clamped_off_middle",
     0.201,
     15.9,
     0.4,
     {EndSupport::clamped, EndSupport::free},
     SectionKind::exact},
};

constexpr double tolerance = 1e-6;  // of nystrom

Case example(const Strike& strike, MeshKind mesh, int count,
             Method method = Method::central_difference) {
  Case input;
  input.scene.beam = {.length = 0.7112,
                      .width = 0.0163,
                      .thickness = 0.0075,
                      .density = 2600.0,
                      .youngs_modulus = 71.96e9,
                      .yield_stress = 150e6};
  input.scene.beam.ends = strike.ends;
  input.scene.striker.mass = strike.mass;
  input.scene.striker.nose_radius = 0.01;
  input.scene.striker.velocity = strike.velocity;
  input.scene.striker.position = strike.position;
  input.model.mesh = mesh;
  input.model.segments = count;
  input.model.section = strike.section;
  input.solver.method = method;
  input.solver.rtol = tolerance;
  input.output.interval = 0.0;
  input.output.shapes = 0.0;
  input.end_time = 0.84e-3;
  return input;
}

struct Point {
  std::string strike, mesh;
  int count;
  std::size_t unknowns;
  long steps;
  double error, median, seconds;  // s
};

Point point_of(const Strike& strike, MeshKind mesh, int count, Method method,
               const std::vector<SubImpact>& limit) {
  Result result;
  double seconds = HUGE_VAL;
  for (int i = 0; i < repetitions; ++i) {
    result = simulate(example(strike, mesh, count, method));
    seconds = std::min(seconds, result.work.wall_seconds);
  }
  const EventErrors errors = event_errors(result.sub_impacts, limit);
  return {strike.name,
          method == Method::nystrom ? "mixed by nystrom"
          : mesh == MeshKind::mixed ? "mixed"
                                    : "cells",
          count,
          result.used.n_unknowns,
          result.work.steps,
          errors.overall(),
          errors.median,
          seconds};
}

// Of cells, extrapolated at second order from two meshes; what free ends add of first order is
// 0.003 us there.
std::vector<SubImpact> limit_of(const Strike& strike) {
  const Result coarse = simulate(example(strike, MeshKind::cells, 4001));
  const Result fine = simulate(example(strike, MeshKind::cells, 8001));
  std::vector<SubImpact> limit = fine.sub_impacts;
  const auto extrapolated = [](double from, double to) { return to + (to - from) / 3.0; };
  for (std::size_t i = 0; i < std::min(limit.size(), coarse.sub_impacts.size()); ++i) {
    const SubImpact& below = coarse.sub_impacts[i];
    limit[i].start = extrapolated(below.start, limit[i].start);
    if (limit[i].end && below.end) limit[i].end = extrapolated(*below.end, *limit[i].end);
  }
  return limit;
}

std::vector<Point> converge(const Strike& strike) {
  const std::vector<SubImpact> limit = limit_of(strike);
  const Result finest = simulate(example(strike, MeshKind::mixed, 3000));
  fmt::print("{}: 3000 mixed cells are within {:.3f} us of the limit of cells\n", strike.name,
             us * event_errors(finest.sub_impacts, limit).overall());
  std::vector<Point> points;
  const auto add = [&](MeshKind mesh, int count, Method method = Method::central_difference) {
    points.push_back(point_of(strike, mesh, count, method, limit));
    const Point& p = points.back();
    fmt::print("{:18} {:16} {:6} {:6} {:8} {:10.4f} {:10.4f} {:10.2f}\n", p.strike, p.mesh, p.count,
               p.unknowns, p.steps, p.error * us, p.median * us, 1e3 * p.seconds);
    std::fflush(stdout);
  };
  for (const int n : {140, 200, 260, 320, 400, 500, 700, 1000}) add(MeshKind::mixed, n);
  for (const int n : {501, 701, 901, 1201, 1601, 1901, 2401, 3201}) add(MeshKind::cells, n);
  if (&strike == strikes || strike.section == SectionKind::elastic) {
    for (const int n : {200, 260, 400, 500, 700, 1000}) {
      add(MeshKind::mixed, n, Method::nystrom);
    }
  }
  return points;
}

// The shortest time in which a mesh, or a finer one, stays within `wanted`.
double seconds_within(const std::vector<Point>& points, const std::string& mesh, double wanted) {
  double seconds = HUGE_VAL;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    if (p->mesh != mesh) continue;
    if (p->error > wanted) break;
    seconds = p->seconds;
  }
  return seconds;
}

void print_ratios(const std::vector<Point>& points) {
  for (const double wanted : {1e-6, 3e-7, 1e-7}) {
    const double mixed = seconds_within(points, "mixed", wanted);
    const double cells = seconds_within(points, "cells", wanted);
    fmt::print("{:18} within {:.1f} us: mixed {:.2f} ms, cells {:.2f} ms, ratio {:.1f}\n",
               points.front().strike, us * wanted, 1e3 * mixed, 1e3 * cells, cells / mixed);
  }
}

void write_points(const std::string& directory, const std::vector<Point>& points) {
  std::ofstream csv(directory + "/convergence.csv");
  csv << "strike,mesh,count,unknowns,steps,max_error_us,median_error_us,wall_ms\n";
  for (const Point& p : points) {
    csv << fmt::format("{},{},{},{},{},{:.4e},{:.4e},{:.3f}\n", p.strike, p.mesh, p.count,
                       p.unknowns, p.steps, p.error * us, p.median * us, 1e3 * p.seconds);
  }
}

void draw(const std::string& directory, const std::vector<Point>& points) {
  std::string script(embedded_file("figures/style.gp"));
  for (const char* mesh : {"mixed", "cells"}) {
    script += fmt::format("${} << EOD\n", mesh);
    for (const Point& p : points) {
      if (p.strike != strikes[0].name || p.mesh != mesh) continue;
      script += fmt::format("{} {:.6e} {:.6e}\n", p.unknowns, p.error * us, 1e3 * p.seconds);
    }
    script += "EOD\n";
  }
  script +=
      "set logscale xy\nset format y '10^{%T}'\nset ylabel 'largest error of a start or end, us'\n"
      "set key bottom left Left reverse\nset multiplot layout 1,2\n"
      "set xlabel 'unknowns of the half model'\n"
      "plot $mixed using 1:2 with linespoints lw 2 lt 1 title 'mixed cells', "
      "$cells using 1:2 with linespoints lw 2 lt 2 title 'cells'\n"
      "set xlabel 'time of the run, ms'\n"
      "plot $mixed using 3:2 with linespoints lw 2 lt 1 title 'mixed cells', "
      "$cells using 3:2 with linespoints lw 2 lt 2 title 'cells'\nunset multiplot\n";
  draw_figure(directory, "convergence", script, {1100, 480});
  // The study itself is the script, and the page shows the SVG.
  for (const char* other : {".gp", ".png", ".pdf"}) {
    std::filesystem::remove(directory + "/convergence" + other);
  }
}

}  // namespace

// Without arguments the tables; `scenes N SEED`: random strikes.
int main(int argc, char** argv) {
  if (argc == 4 && argv[1] == std::string("scenes")) {
    return study_random_scenes(std::stoi(argv[2]), static_cast<unsigned>(std::stoul(argv[3])));
  }
  const std::string directory = SUBIMPACT_MIXED_STUDY;
  std::vector<Point> all;
  for (const Strike& strike : strikes) {
    const std::vector<Point> points = converge(strike);
    print_ratios(points);
    all.insert(all.end(), points.begin(), points.end());
  }
  write_points(directory, all);
  draw(directory, all);
}
