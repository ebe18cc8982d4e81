#include "subimpact/report/html_report.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "case/counted.h"
#include "io/csv_table.h"
#include "io/write_file.h"
#include "report/html_text.h"
#include "report/strike_words.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr const char* style = R"(
body { font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: #1b1b1b;
       background: #fff; max-width: 68rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; line-height: 1.25; margin-bottom: 0.2rem; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 0.6rem; border-bottom: 1px solid #d0d0d0; }
.sub { color: #555; margin-top: 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); gap: 0.8rem; margin: 1.4rem 0; padding: 0; }
.tiles div { border: 1px solid #d8d8d8; border-radius: 6px; padding: 0.5rem 0.8rem; }
.tiles b { display: block; font-size: 1.35rem; font-weight: 600; }
.tiles span { color: #555; font-size: 0.85rem; }
.failed, .warning { border-left: 4px solid #D55E00; padding: 0.4rem 0.8rem; }
.failed { background: #fbe9df; font-weight: 600; }
.warning { border-color: #E69F00; }
figure { margin: 1.6rem 0; break-inside: avoid; }
figure svg { width: 100%; height: auto; }
figcaption { color: #333; font-size: 0.92rem; max-width: 48rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.88rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.18rem 0.55rem; text-align: right; white-space: nowrap; }
th { border-bottom: 1px solid #888; font-weight: 600; vertical-align: bottom; }
th small { font-weight: 400; color: #555; display: block; }
tr.zone td { text-align: left; color: #555; padding-top: 0.7rem; border-bottom: 1px solid #e4e4e4; }
table.keys td { text-align: left; white-space: normal; vertical-align: top; }
table.keys td:first-child { color: #555; white-space: nowrap; }
@media print { body { max-width: none; margin: 0; } .wide { overflow: visible; } }
)";

class Page {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_.push_back('\n');
  }
  void heading(const char* text) { add("<h2>{}</h2>", text); }
  void row(const std::string& label, const std::string& value) {
    add("<tr><td>{}</td><td>{}</td></tr>", escaped(label), escaped(value));
  }
  std::string str() const { return fmt::to_string(text_); }

 private:
  fmt::memory_buffer text_;
};

void add_tiles(Page& page, const Result& result) {
  const auto tile = [&](const std::string& value, const std::string& label) {
    page.add("<div><b>{}</b><span>{}</span></div>", escaped(value), label);
  };
  const auto zones = summarise_zones(result.sub_impacts);
  page.add("<div class=\"tiles\">");
  tile(fmt::format("{}", result.sub_impacts.size()),
       noun_after(result.sub_impacts.size(), "sub-impact"));
  tile(fmt::format("{}", zones.size()), noun_after(zones.size(), "zone"));
  tile(fmt::format("{:.4g} kN", 1e-3 * result.max_force), "largest force");
  tile(fmt::format("{:.4g} mm", 1e3 * result.max_indentation), "largest indentation");
  tile(fmt::format("{:.4g} m/s", result.striker_velocity), "striker, at the end");
  tile(fmt::format("{:.4g} m/s", result.beam_mean_velocity), "beam (mean), at the end");
  page.add("</div>");
}

// What a reader must know before the numbers.
void add_banner(Page& page, const Result& result) {
  const std::string caveat = outcome_caveat(result);
  if (!caveat.empty()) page.add("<p class=\"failed\">{}.</p>", escaped(caveat));
  for (const std::string& warning : result.warnings) {
    page.add("<p class=\"warning\">Warning: {}.</p>", escaped(warning));
  }
}

void add_figures(Page& page, const DrawnFigures& figures,
                 const std::filesystem::path& figure_directory) {
  page.heading("Figures");
  int number = 0;
  for (const DrawnFigure& figure : figures.drawn) {
    const std::string svg = read_whole_file(figure_directory / (figure.name + ".svg"));
    page.add("<figure id=\"figure-{}\">{}<figcaption><b>Figure {}.</b> {}</figcaption></figure>",
             figure.name, inlined_svg(svg, figure.name), ++number, escaped(figure.caption));
  }
  for (const std::string& reason : figures.left_out) {
    page.add("<p>Not drawn: {}.</p>", escaped(reason));
  }
}

void add_table(Page& page, const Result& result) {
  page.heading("Sub-impacts");
  const std::string caveat = outcome_caveat(result);
  if (!caveat.empty()) page.add("<p class=\"failed\">{}.</p>", escaped(caveat));
  const bool with_errors = result.trust.has_value();
  page.add(
      "<div class=\"wide\"><table><thead><tr><th>no.</th><th>start<small>µs</small></th>"
      "<th>end<small>µs</small></th><th>duration<small>µs</small></th>"
      "<th>peak force<small>N</small></th><th>impulse<small>mN s</small></th>"
      "<th>indentation<small>max, mm</small></th><th>residual<small>mm</small></th>"
      "<th>striker<small>m/s</small></th>{}</tr></thead><tbody>",
      with_errors ? "<th>± start<small>µs, all</small></th><th>± end<small>µs, all</small></th>"
                    "<th>± time<small>µs, alone</small></th>"
                  : "");
  const auto error = [](const std::optional<double>& e) {
    return e ? fmt::format("<td>{:.1e}</td>", 1e6 * *e) : std::string("<td>?</td>");
  };
  int zone = 0, subzone = 0;
  std::size_t index = 0;
  for (const SubImpact& s : result.sub_impacts) {
    if (s.zone != zone || s.subzone != subzone) {
      page.add("<tr class=\"zone\"><td colspan=\"{}\">zone {}, sub-zone {}</td></tr>",
               with_errors ? 12 : 9, s.zone, s.subzone);
      zone = s.zone;
      subzone = s.subzone;
    }
    page.add(
        "<tr><td>{}</td><td>{:.4f}</td><td>{}</td><td>{}</td><td>{:.1f}</td><td>{:.4f}</td>"
        "<td>{:.6f}</td><td>{:.6f}</td><td>{:.5f}</td>{}</tr>",
        ++index, 1e6 * s.start, s.end ? fmt::format("{:.4f}", 1e6 * *s.end) : "(open)",
        s.end ? fmt::format("{:.4f}", 1e6 * (*s.end - s.start)) : "", s.peak_force, 1e3 * s.impulse,
        1e3 * s.max_indentation, 1e3 * s.residual_indentation, s.striker_velocity,
        with_errors ? error(s.start_error) + error(s.end_error) + error(s.error_time)
                    : std::string());
  }
  page.add("</tbody></table></div>");
}

void add_case(Page& page, const Case& input) {
  page.heading("Case");
  page.add("<table class=\"keys\"><tbody>");
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    if (!value || key.name == "title") continue;
    page.row(key.name, to_text(*value) + (key.unit.empty() ? "" : " " + key.unit));
  }
  page.add("</tbody></table>");
}

void add_method(Page& page, const FinishedRun& run) {
  const Result& result = run.result;
  const ResolvedSettings& used = result.used;
  const Work& work = result.work;
  page.heading("Method");
  page.add("<table class=\"keys\"><tbody>");
  page.row("mesh",
           fmt::format("{}; {} of the beam, {}", used.mesh, counted(used.n_unknowns, "unknown"),
                       counted(used.n_sections, "section")));
  page.row("method", fmt::format("{}{}", to_string(run.input.solver.method),
                                 used.table ? ", table " + *used.table : ""));
  page.row("step", used.step ? duration_text(*used.step) + ", fixed"
                             : fmt::format("adaptive, to {:.2g} m and {:.2g} m/s",
                                           used.position_tolerance, used.velocity_tolerance));
  page.row("events", std::string(to_string(used.events)));
  page.row("first bending period", duration_text(used.first_period));
  page.row("work",
           fmt::format("{}, {} rejected, {}, {} located; {}", counted(work.steps, "step"),
                       work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                       counted(work.roots, "event"), duration_text(work.wall_seconds)));
  page.add("</tbody></table>");
}

void add_trust(Page& page, const Result& result) {
  page.heading("Error bars");
  if (!result.trust) {
    page.add(
        "<p>None were asked for; <code>subimpact run --error-bars</code> states the error of "
        "every start and end.</p>");
    return;
  }
  const Trust& trust = *result.trust;
  page.add("<p>From refined runs, each of which changes one thing:</p>");
  page.add(
      "<div class=\"wide\"><table class=\"keys\"><thead><tr><th>error of</th><th>refined run</th>"
      "<th>times within</th><th>valid</th></tr></thead><tbody>");
  for (const Trust::Part& part : trust.parts) {
    page.add(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>", escaped(part.name),
        escaped(part.companion),
        part.first_undecided == std::size_t{0} ? std::string()
                                               : fmt::format("{:.1e} µs", 1e6 * part.largest_error),
        part.first_undecided
            ? fmt::format("before sub-impact {}; from there on count and order are uncertain: {}",
                          *part.first_undecided + 1, escaped(part.reason))
            : std::string("for all sub-impacts"));
  }
  page.add("</tbody></table></div>");
  if (trust.first_undecided) {
    page.add("<p>With all errors added, sub-impact {} is the first that is uncertain.</p>",
             *trust.first_undecided + 1);
  }
}

void add_conservation(Page& page, const Result& result) {
  page.heading("Conservation");
  page.add(
      "<p>At every row the total energy equals the initial {:.6g} J to within {:.1e}, relative. {}"
      "</p>",
      result.used.initial_energy, result.max_energy_error,
      result.max_momentum_error
          ? fmt::format("Total momentum is conserved to within {:.1e}, relative.",
                        *result.max_momentum_error)
          : std::string("The supports take momentum up."));
  if (result.history.empty()) return;
  const HistoryRow& last = result.history.back();
  page.add(
      "<table><thead><tr><th>at {}<small>J</small></th><th>striker<small>kinetic</small></th>"
      "<th>beam<small>kinetic</small></th><th>bending<small>elastic</small></th>"
      "<th>bending<small>plastic</small></th><th>contact<small>elastic</small></th>"
      "<th>contact<small>plastic</small></th></tr></thead><tbody><tr><td></td>"
      "<td>{:.5g}</td><td>{:.5g}</td><td>{:.5g}</td><td>{:.5g}</td><td>{:.5g}</td>"
      "<td>{:.5g}</td></tr></tbody></table>",
      escaped(duration_text(last.time)), last.striker_energy, last.beam_kinetic_energy,
      last.bending_elastic, last.bending_plastic, last.contact_elastic, last.contact_plastic);
}

}  // namespace

std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory) {
  const Result& result = run.result;
  const std::string title = run.input.title.empty() ? "A strike" : escaped(run.input.title);
  Page page;
  page.add("<!DOCTYPE html>");
  page.add("<html lang=\"en\"><head><meta charset=\"utf-8\"/>");
  page.add("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>");
  page.add("<title>{}</title><style>{}</style></head><body>", title, style);
  page.add("<h1>{}</h1>", title);
  page.add(
      "<p class=\"sub\">A beam of {:.4g} kg struck by {:.4g} kg at {:.4g} m/s; outcome: {} at "
      "{}.</p>",
      run.input.scene.beam.mass(), run.input.scene.striker.mass, run.input.scene.striker.velocity,
      to_string(result.outcome.kind), escaped(duration_text(result.outcome.time)));
  add_banner(page, result);
  add_tiles(page, result);
  page.heading("In words");
  for (const std::string& paragraph : strike_words(run.input, result)) {
    page.add("<p>{}</p>", escaped(paragraph));
  }
  add_figures(page, figures, figure_directory);
  add_table(page, result);
  add_case(page, run.input);
  add_method(page, run);
  add_trust(page, result);
  add_conservation(page, result);
  std::string libraries;
  for (const auto& [name, version] : run.libraries)
    libraries += fmt::format(", {} {}", name, version);
  page.add("<p class=\"sub\">subimpact {}{}</p>", escaped(run.program_version), escaped(libraries));
  page.add("</body></html>");
  return page.str();
}

std::filesystem::path write_html_report(const std::filesystem::path& directory,
                                        const FinishedRun& run) {
  const DrawnFigures figures = draw_figures(directory, run.input, run.result);
  const std::filesystem::path path = directory / "report.html";
  write_file(path, html_report(run, figures, directory));
  return path;
}

}  // namespace subimpact
