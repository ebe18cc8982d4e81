#include "report/figures/gnuplot.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
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

#include "io/directory/listed_files.h"
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

/// An open file, closed with this object.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {
    if (number < 0) throw std::system_error(errno, std::generic_category(), "a file for gnuplot");
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

// A file in memory: what is written into it never stops the process that writes.
int make_memory_file() { return ::memfd_create("gnuplot", MFD_CLOEXEC); }

// Variables by which users change what gnuplot draws.
bool changes_figures(std::string_view variable) {
  if (variable.starts_with("GNUPLOT_")) return true;
  const std::string_view name = variable.substr(0, variable.find('='));
  return name == "GNUTERM" || name == "GDFONTPATH";
}

std::vector<char*> environment() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!changes_figures(*variable)) variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  return variables;
}

// The process of gnuplot in a directory: ended after so many seconds with all that it started, and
// with this process. Returns errno.
int start(const fs::path& directory, double seconds, std::vector<std::string> arguments, int output,
          int errors, pid_t& child) {
  std::vector<std::string> words = {"setpriv", "--pdeathsig", "KILL", "timeout", "-k", "1"};
  words.insert(words.end(), {fmt::format("{:.3f}", seconds), "setpriv", "--pdeathsig", "KILL"});
  words.insert(words.end(), {"gnuplot", "-d"});
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  const int error =
      ::posix_spawnp(&child, list[0], &actions, nullptr, list.data(), environment().data());
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

// Reads what a process writes until it ends. What it started may hold the pipe for longer.
int read_to_end(int pipe, pid_t child, std::string& text) {
  std::array<char, 1 << 14> buffer;
  pollfd stream{pipe, POLLIN, 0};
  int state = 0;
  bool has_ended = false;
  for (ssize_t n = 1; n != 0;) {
    if (::poll(&stream, 1, 100) > 0) {
      n = ::read(pipe, buffer.data(), buffer.size());
      if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
    } else if (has_ended) {
      return state;
    } else {
      has_ended = ::waitpid(child, &state, WNOHANG) == child;
    }
  }
  while (!has_ended && ::waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  return state;
}

// Runs gnuplot in a directory, with its default settings: neither ~/.gnuplot nor the variables of
// the environment that gnuplot obeys have an effect. No shell comes between, so that any name of a
// directory is only a name.
GnuplotRun run_gnuplot(const fs::path& directory, std::vector<std::string> arguments,
                       Clock::time_point deadline) {
  const double seconds = std::chrono::duration<double>(deadline - Clock::now()).count();
  std::array<int, 2> ends{-1, -1};
  const int failed = ::pipe2(ends.data(), O_CLOEXEC);
  const Descriptor output(failed == 0 ? ends[0] : -1);
  auto input = std::make_unique<Descriptor>(ends[1]);
  const Descriptor errors(make_memory_file());
  GnuplotRun run;
  pid_t child = 0;
  run.start_error =
      start(directory, std::max(seconds, 1e-3), std::move(arguments), *input, errors, child);
  if (run.start_error != 0) return run;
  input.reset();  // the end of the output is that of gnuplot
  const int state = read_to_end(output, child, run.output);
  run.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  run.errors.resize(static_cast<std::size_t>(::lseek(errors, 0, SEEK_END)));
  if (::pread(errors, run.errors.data(), run.errors.size(), 0) < 0) {
    throw std::system_error(errno, std::generic_category(), "a file for gnuplot");
  }
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
