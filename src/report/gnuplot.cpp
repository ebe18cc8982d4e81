#include "report/gnuplot.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>

#include "io/write_file.h"
#include "report/files.h"
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

std::string figure_style() { return std::string(embedded_file("figures/style.gp")); }

std::string figure_script(const std::string& name, const std::string& settings) {
  return figure_style() + std::string(embedded_file("figures/tables.gp")) + settings +
         std::string(embedded_file("figures/" + name + ".gp"));
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
