#include "report/gnuplot.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>

#include "io/write_file.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr int exit_status_not_found = 127;  // of a shell

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

struct Finished {
  int status;
  std::string said;
};

Finished run_shell(const std::string& command) {
  std::fflush(nullptr);
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {exit_status_not_found, {}};
  std::string said;
  std::array<char, 512> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    said.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
}

void draw(const std::filesystem::path& directory, const std::string& name,
          const std::string& ending, const std::string& terminal) {
  const std::string output = name + "." + ending;
  const std::string settings =
      fmt::format("set terminal {}; set output \"{}\"; set encoding utf8", terminal, output);
  const Finished gnuplot =
      run_shell(fmt::format("cd {} && exec gnuplot -e {} {} 2>&1 </dev/null",
                            quoted(directory.string()), quoted(settings), quoted(name + ".gp")));
  if (gnuplot.status == 0) return;
  if (gnuplot.status == exit_status_not_found) {
    throw OutputError(
        fmt::format("{}: cannot be drawn, because gnuplot is not installed; install it (Debian: "
                    "apt-get install gnuplot-nox) and repeat the command; the other files are "
                    "complete",
                    (directory / output).string()));
  }
  throw OutputError(fmt::format("{}: gnuplot failed with status {} on {}: {}",
                                (directory / output).string(), gnuplot.status,
                                (directory / (name + ".gp")).string(), gnuplot.said));
}

}  // namespace

std::string figure_style() {
  return R"(set linetype 1 lc rgb '#0072B2' lw 2 pt 7
set linetype 2 lc rgb '#D55E00' lw 2 pt 5
set linetype 3 lc rgb '#009E73' lw 2 pt 9
set linetype 4 lc rgb '#CC79A7' lw 2 pt 13
set linetype 5 lc rgb '#E69F00' lw 2 pt 11
set linetype 6 lc rgb '#56B4E9' lw 2 pt 15
set linetype 7 lc rgb '#000000' lw 2 pt 6
set linetype 8 lc rgb '#8B7500' lw 2 pt 4
set border 3 lc rgb '#404040'
set tics nomirror
set grid lc rgb '#D8D8D8' lw 0.5
)";
}

void draw_figure(const std::filesystem::path& directory, const std::string& name,
                 const std::string& script, FigureSize size) {
  write_file(directory / (name + ".gp"), script);
  draw(directory, name, "svg",
       fmt::format("svg size {},{} dynamic enhanced font 'Helvetica,Arial,sans-serif,14' "
                   "background rgb 'white'",
                   size.width, size.height));
  // Twice the pixels, for screens and print that resolve them.
  draw(directory, name, "png",
       fmt::format("pngcairo size {},{} enhanced font 'sans,14' fontscale 2 linewidth 2 "
                   "pointscale 2 background rgb 'white'",
                   2 * size.width, 2 * size.height));
}

}  // namespace subimpact
