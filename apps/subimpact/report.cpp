#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "commands.h"
#include "print.h"
#include "subimpact/io/results.h"
#include "subimpact/report/html_report.h"

namespace subimpact::app {
namespace {

struct ReportOptions {
  std::string run;
  std::string directory;
};

int report(const ReportOptions& options) {
  const FinishedRun run = read_results(options.run);
  OutputDirectory directory(options.directory.empty() ? options.run : options.directory, "figures",
                            run.identity);
  const WrittenReport written = write_html_report(directory.staging(), run);
  directory.commit();
  print("{}\n", (directory.path() / written.page.filename()).string());
  std::fflush(stdout);
  print_warnings(directory.notes());
  print_figure_notes(run);
  throw_if_failed(written.figures);
  return done;
}

}  // namespace

void add_report(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("report", "Write a finished run up as one page of HTML");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->run, "Output directory of `subimpact run`")->required();
  command->add_option("--out", options->directory,
                      "Directory for report.html and its figures; made if missing. Default: DIR");
  command->footer(
      "report.html holds case, summary in words, figures, table, method, error bars and "
      "conservation; it needs no other file and no network. Figures are drawn with gnuplot.\n"
      "Examples:\n"
      "  subimpact run case.toml --out out/first --error-bars --set output.sections=0.5,0.4\n"
      "  subimpact report out/first\n"
      "Exit status: 0 done; 2 bad command line, files that no run has written, or gnuplot "
      "missing; 3 a figure could not be drawn, the page is written without it.");
  command->callback([options, &status] { status = report(*options); });
}

}  // namespace subimpact::app
