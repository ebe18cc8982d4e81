// Energies and relative displacements, with zones and sub-zones marked.

#include <fmt/format.h>

#include <algorithm>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr Box strip{0.15, 0.97, 0.905, 0.985};
constexpr Box upper{0.15, 0.97, 0.46, 0.89};
constexpr Box lower{0.15, 0.97, 0.1, 0.43};

struct Span {
  double from, to;
  int number;
};

// Runs of sub-impacts that share a number.
template <class Number>
std::vector<Span> spans(const Result& result, TimeUnit unit, Number number) {
  std::vector<Span> found;
  int last_zone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const double from = s.start * unit.per_second;
    const double to = s.end.value_or(result.outcome.time) * unit.per_second;
    const bool same = !found.empty() && found.back().number == number(s) && last_zone == s.zone;
    if (!same) found.push_back({from, to, number(s)});
    found.back().to = to;
    last_zone = s.zone;
  }
  return found;
}

// A bar in a row of the strip.
std::string bar(const Span& span, double bottom, double top, const char* colour) {
  return fmt::format(
      "set object rectangle from first {:.7g}, first {} to first {:.7g}, first {} fillcolor rgb "
      "'{}' fillstyle solid noborder\n",
      span.from, bottom, span.to, top, colour);
}

std::string bar_number(const Span& span, double height) {
  return fmt::format("set label '{}' at first {:.7g}, first {} center font ',12' front\n",
                     span.number, 0.5 * (span.from + span.to), height);
}

}  // namespace

FigureScript energies_figure(const Case&, const Result& result) {
  FigureScript figure("energies",
                      "Energies, and the motion of striker (u_mf = w_m - w(0)) and struck point "
                      "(f_c = w_c - w(0)) relative to the beam's end. Above: zones, sub-zones and "
                      "sub-impacts; zones are shaded.",
                      {800, 660});
  const TimeUnit unit = time_unit(result.outcome.time);
  const double end = result.outcome.time * unit.per_second;
  const Unit joule = energy_unit(result.used.initial_energy);
  const Unit metre = length_unit(std::max(largest(result, &HistoryRow::struck_deflection),
                                          largest(result, &HistoryRow::striker_relative)));
  const auto zones = spans(result, unit, [](const SubImpact& s) { return s.zone; });
  const auto subzones = spans(result, unit, [](const SubImpact& s) { return s.subzone; });

  figure << fmt::format("set xrange [0:{:.7g}]\n", end);
  figure.place(strip);
  figure << "set yrange [0:3]\nset format x ''\nset ytics ('zones' 2.5, 'sub-zones' 1.5, "
            "'sub-impacts' 0.5) font ',12' scale 0\nunset border\nunset xtics\nunset grid\n";
  for (const Span& zone : zones) {
    figure << bar(zone, 2.08, 2.92, zone_colour);
    if (zone.to - zone.from > 0.012 * end) figure << bar_number(zone, 2.5);
  }
  for (const Span& subzone : subzones) {
    figure << bar(subzone, 1.08, 1.92, subzone_colour);
    if (subzone.to - subzone.from > 0.012 * end) figure << bar_number(subzone, 1.5);
  }
  for (const auto& band : sub_impact_bands(result, unit)) {
    figure << bar({band.from, band.to, 0}, 0.08, 0.92, "#E69F00");
  }
  figure << "plot NaN notitle\nunset label\nset border 3\nset ytics autofreq scale 1 font ',14'\n"
         << fmt::format("set xtics {}\nset grid\n", tic_spacing(end, 8));

  std::vector<FigureScript::Band> bands;
  for (const Span& zone : zones) bands.push_back({zone.from, zone.to, "#F0F0F0"});
  figure.shade(bands);
  figure.place(upper);
  struct Column {
    double HistoryRow::*member;
    const char* title;
  };
  const Column energies[] = {{&HistoryRow::striker_energy, "striker U_m"},
                             {&HistoryRow::beam_kinetic_energy, "beam, kinetic U_k"},
                             {&HistoryRow::bending_elastic, "bending, elastic U_e"},
                             {&HistoryRow::bending_plastic, "bending, plastic U_p"},
                             {&HistoryRow::contact_plastic, "contact, plastic D_c"}};
  figure << fmt::format("set ylabel 'energy, {}'\n", joule.name)
         << "set yrange [0:*]\nset key top center maxrows 3 "
            "samplen 2.5\n";
  std::string plot = "plot ";
  for (const Column& column : energies) {
    const std::string data =
        figure.line(history_line(result, unit, column.member, joule.factor), upper);
    plot += fmt::format("{} with lines title '{}', ", data, column.title);
  }
  figure << plot + "NaN notitle\n";

  figure.place(lower);
  const std::string u =
      figure.line(history_line(result, unit, &HistoryRow::striker_relative, metre.factor), lower);
  const std::string f =
      figure.line(history_line(result, unit, &HistoryRow::struck_deflection, metre.factor), lower);
  figure << fmt::format("set ylabel 'deformation, {}'\n", metre.name)
         << "set yrange [*:*]\nset format x '% h'\n"
            "set key bottom right maxrows 2\nset offsets 0, 0, graph 0.05, 0\n"
         << fmt::format("set xlabel 'time, {}'\n", unit.name)
         << fmt::format(
                "plot {} with lines lc 1 title 'struck point f_c', {} with lines lc 2 "
                "dashtype 2 title 'striker u_{{mf}}'\n",
                f, u);
  return figure;
}

}  // namespace subimpact
