#include "report/gnuplot.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "io/sealed_files.h"
#include "io/write_file.h"
#include "report/files.h"
#include "report/run_gnuplot.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// When a drawing must be complete.
struct TimeLimit {
  std::chrono::milliseconds allowed;
  Clock::time_point end;
};

void throw_if_not_started(const std::string& figure, int error) {
  if (error == 0) return;
  if (error == ENOENT) {
    throw GnuplotMissing(
        fmt::format("{}: cannot be drawn, because gnuplot is not installed; install it (Debian: "
                    "apt-get install gnuplot-nox) and repeat the command; the other files are "
                    "complete",
                    figure));
  }
  const std::string message = fmt::format(
      "{}: cannot be drawn, because gnuplot cannot be started ({})", figure, std::strerror(error));
  // For want of memory or of room for a process, which the next figure may find.
  if (error == ENOMEM || error == EAGAIN) throw FigureError(message);
  throw GnuplotMissing(message);
}

// The last lines that were printed, among which is the cause: fonts alone can print hundreds.
std::string last_lines(const std::string& text) {
  constexpr int most = 12;
  std::size_t start = text.find_last_not_of('\n');
  if (start == std::string::npos) return {};
  for (int n = 0; n < most && start != std::string::npos; ++n) {
    start = start == 0 ? std::string::npos : text.rfind('\n', start - 1);
  }
  return start == std::string::npos ? text : "..." + text.substr(start);
}

// gnuplot draws into a pipe, and the figure is written when it is complete.
void draw(const fs::path& directory, const std::string& name, const std::string& ending,
          const std::string& terminal, TimeLimit limit) {
  const std::string figure = name + "." + ending;  // the directory is that of staged files
  const GnuplotRun gnuplot = run_gnuplot(
      directory, {"-e", fmt::format("set terminal {}; set encoding utf8", terminal), name + ".gp"},
      limit.end);
  throw_if_not_started(figure, gnuplot.start_error);
  if (gnuplot.took_too_long) {
    throw FigureError(fmt::format(
        "{}: gnuplot was ended, because it had not drawn {}.gp within {:g} s; if the machine is "
        "busy or memory is limited (ulimit -v), lift this and repeat the command",
        figure, name, 1e-3 * static_cast<double>(limit.allowed.count())));
  }
  if (gnuplot.status != 0) {
    throw FigureError(fmt::format("{}: gnuplot failed with status {} on {}.gp: {}", figure,
                                  gnuplot.status, name, last_lines(gnuplot.errors)));
  }
  write_file(directory / figure, gnuplot.output);
}

void draw_all(const fs::path& directory, const std::string& name, FigureSize size,
              TimeLimit limit) {
  draw(directory, name, "svg",
       fmt::format("svg size {},{} dynamic enhanced font 'Helvetica,Arial,sans-serif,14' "
                   "background rgb 'white'",
                   size.width, size.height),
       limit);
  // Twice the pixels, for screens and print that resolve them.
  draw(directory, name, "png",
       fmt::format("pngcairo size {},{} enhanced font 'sans,14' fontscale 2 linewidth 2 "
                   "pointscale 2 background rgb 'white'",
                   2 * size.width, 2 * size.height),
       limit);
  constexpr double pixels_per_inch = 96.0;
  draw(directory, name, "pdf",
       fmt::format("pdfcairo size {:.4f}in,{:.4f}in enhanced font 'sans,14' fontscale 0.75 "
                   "linewidth 1 pointscale 0.6 background rgb 'white'",
                   size.width / pixels_per_inch, size.height / pixels_per_inch),
       limit);
}

void remove_pictures(const fs::path& directory, const std::string& name) {
  std::error_code ignored;
  for (const char* ending : {".svg", ".png", ".pdf"}) {
    fs::remove(directory / (name + ending), ignored);
  }
}

// Is in every figure's script, and distinguishes it from scripts without data.
constexpr std::string_view finished_mark =
    "# A finished script: style, data and drawing of one figure. Not for plot --scripts.\n";

}  // namespace

std::string figure_style() { return std::string(embedded_file("figures/style.gp")); }

std::string figure_script(const std::string& name, const std::string& settings,
                          const fs::path& scripts) {
  const auto file = [&](const std::string& script) {
    const fs::path own = scripts / (script + ".gp");
    return !scripts.empty() && fs::exists(own)
               ? read_whole_file(own)
               : std::string(embedded_file("figures/" + script + ".gp"));
  };
  return std::string(finished_mark) + file("style") + file("tables") + settings + file(name);
}

bool is_finished_script(const std::string& text) {
  return text.find(finished_mark) != std::string::npos ||
         text.find("\nmarks = \"") != std::string::npos;  // of a version without that line
}

void draw_figure(const fs::path& directory, const std::string& name, const std::string& script,
                 FigureSize size, std::chrono::milliseconds most_time) {
  remove_pictures(directory, name);  // of an earlier drawing
  try {
    write_file(directory / (name + ".gp"), script);
    draw_all(directory, name, size, {most_time, Clock::now() + most_time});
  } catch (const FigureError&) {
    remove_pictures(directory, name);
    throw;
  } catch (const OutputError&) {
    remove_figure(directory, name);
    throw;
  }
}

void remove_figure(const fs::path& directory, const std::string& name) {
  std::error_code ignored;
  remove_pictures(directory, name);
  fs::remove(directory / (name + ".gp"), ignored);
}

}  // namespace subimpact
