#include "report/gnuplot.h"

#include <fmt/format.h>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

#include "io/listed_files.h"
#include "report/files.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// What a process of gnuplot left behind.
struct GnuplotRun {
  int start_error = 0;  ///< errno if no process could be started, else 0
  int status = 0;       ///< of its exit; minus the signal's number if one ended it
  std::string output, errors;
};

// All that a process writes into a stream, or what was written into a file.
std::string read_to_end(std::FILE* stream) {
  std::array<char, 1 << 14> buffer;
  std::string text;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), stream)) {
    text.append(buffer.data(), n);
  }
  return text;
}

// Runs gnuplot in a directory, with its default settings: neither ~/.gnuplot nor the variables of
// the environment that gnuplot obeys have an effect. At the deadline gnuplot is ended with all that
// it started; it ends with this process too.
GnuplotRun run_gnuplot(const fs::path& directory, const std::vector<std::string>& arguments,
                       Clock::time_point deadline) {
  GnuplotRun run;
  // In memory: what is written into it never stops the process that writes.
  const int number = ::memfd_create("gnuplot", MFD_CLOEXEC);
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> errors(::fdopen(number, "r"), close);
  std::string command = fmt::format(
      "unset $(env | sed -n 's/^\\(GNUPLOT_[^=]*\\|GNUTERM\\|GDFONTPATH\\)=.*/\\1/p'); "
      "cd {} && exec setpriv --pdeathsig KILL timeout -k 1 {:.3f} setpriv --pdeathsig KILL gnuplot "
      "-d 2>/proc/{}/fd/{} </dev/null",
      quoted(fs::absolute(directory)),
      std::max(std::chrono::duration<double>(deadline - Clock::now()).count(), 1e-3), ::getpid(),
      number);
  for (const std::string& argument : arguments) command += fmt::format(" {}", quoted(argument));
  std::FILE* output = errors ? ::popen(command.c_str(), "re") : nullptr;
  if (output == nullptr) {
    run.start_error = errno;
    return run;
  }
  run.output = read_to_end(output);
  const int state = ::pclose(output);
  run.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  std::rewind(errors.get());
  run.errors = read_to_end(errors.get());
  return run;
}

void throw_if_not_started(const std::string& figure, const GnuplotRun& run) {
  constexpr int not_found = 127;  // status of a command that starts another
  if (run.start_error == ENOENT || run.status == not_found) {
    throw GnuplotMissing(
        fmt::format("{}: cannot be drawn, because gnuplot is not installed; install it (Debian: "
                    "apt-get install gnuplot-nox) and repeat the command; the other files are "
                    "complete",
                    figure));
  }
  // For want of memory or of room for a process, which the next figure may find.
  if (run.start_error != 0) {
    throw FigureError(fmt::format("{}: cannot be drawn, because gnuplot cannot be started ({})",
                                  figure, std::strerror(run.start_error)));
  }
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
void draw(const fs::path& directory, const std::string& name, const char* ending,
          const std::string& terminal, std::chrono::milliseconds allowed, Clock::time_point end) {
  const std::string figure = name + ending;  // the directory is that of staged files
  const GnuplotRun gnuplot = run_gnuplot(
      directory, {"-e", fmt::format("set terminal {}; set encoding utf8", terminal), name + ".gp"},
      end);
  throw_if_not_started(figure, gnuplot);
  if (gnuplot.status != 0 && Clock::now() >= end) {
    throw FigureError(fmt::format(
        "{}: gnuplot was ended, because it had not drawn {}.gp within {:g} s; if the machine is "
        "busy or memory is limited (ulimit -v), lift this and repeat the command",
        figure, name, 1e-3 * static_cast<double>(allowed.count())));
  }
  if (gnuplot.status != 0) {
    throw FigureError(fmt::format("{}: gnuplot failed with status {} on {}.gp: {}", figure,
                                  gnuplot.status, name, last_lines(gnuplot.errors)));
  }
  write_file(directory / figure, gnuplot.output);
}

constexpr const char* endings[] = {".svg", ".png", ".pdf"};

// What gnuplot draws into, for each ending.
std::array<std::string, 3> terminals(FigureSize size) {
  constexpr double pixels_per_inch = 96.0;
  return {fmt::format("svg size {},{} dynamic enhanced font 'Helvetica,Arial,sans-serif,14' "
                      "background rgb 'white'",
                      size.width, size.height),
          // Twice the pixels, for screens and print that resolve them.
          fmt::format("pngcairo size {},{} enhanced font 'sans,14' fontscale 2 linewidth 2 "
                      "pointscale 2 background rgb 'white'",
                      2 * size.width, 2 * size.height),
          fmt::format("pdfcairo size {:.4f}in,{:.4f}in enhanced font 'sans,14' fontscale 0.75 "
                      "linewidth 1 pointscale 0.6 background rgb 'white'",
                      size.width / pixels_per_inch, size.height / pixels_per_inch)};
}

void remove_pictures(const fs::path& directory, const std::string& name) {
  std::error_code ignored;
  for (const char* ending : endings) fs::remove(directory / (name + ending), ignored);
}

// Is in every figure's script, and distinguishes it from scripts without data.
constexpr std::string_view finished_mark =
    "# A finished script: style, data and drawing of one figure. Not for plot --scripts.\n";

}  // namespace

std::string quoted(const std::string& word) {
  constexpr const char* plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(plain) == word.npos) return word;
  std::string text;
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return fmt::format("'{}'", text);
}

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
    const auto end = Clock::now() + most_time;
    const auto all = terminals(size);
    for (std::size_t i = 0; i < all.size(); ++i) {
      draw(directory, name, endings[i], all[i], most_time, end);
    }
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
