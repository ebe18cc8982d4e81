#include "report/gnuplot.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>
#include <vector>

#include "io/sealed_files.h"
#include "io/write_file.h"
#include "report/files.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

// --- gnuplot as a process ------------------------------------------------------------------------

/// What a process of gnuplot left behind.
struct GnuplotRun {
  int start_error = 0;         ///< errno if gnuplot could not be started, else 0
  int status = 0;              ///< of its exit; minus the signal's number if one ended it
  bool took_too_long = false;  ///< and was ended
  std::string output, errors;
};

/// A pipe whose ends are closed at the latest with this object.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "a pipe to gnuplot");
    }
  }
  ~Pipe() {
    close_writing_end();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading_end() const { return ends_[0]; }
  int writing_end() const { return ends_[1]; }
  void close_writing_end() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

struct Pipes {
  Pipe output, errors;
  Pipe start_error;  // closed, without a word, when gnuplot starts
};

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

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

// Between fork() and exec: nothing here takes memory or a lock. Returns errno.
int become_gnuplot(const char* directory, char* const* arguments, char* const* variables,
                   const Pipes& pipes) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 ||
      ::dup2(pipes.output.writing_end(), STDOUT_FILENO) < 0 ||
      ::dup2(pipes.errors.writing_end(), STDERR_FILENO) < 0 || ::chdir(directory) != 0) {
    return errno;
  }
  ::execvpe(arguments[0], arguments, variables);
  return errno;
}

// A group of its own, so that what gnuplot starts can be ended with it. Returns -1 if no process
// can be made.
pid_t start(const fs::path& directory, std::vector<std::string>& words, const Pipes& pipes) {
  const std::vector<char*> arguments = pointers(words);
  const std::vector<char*> variables = environment();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it ended before it could take this process with it
  const int error = become_gnuplot(directory.c_str(), arguments.data(), variables.data(), pipes);
  // If this fails, the parent process has ended, too.
  [[maybe_unused]] const ssize_t n = ::write(pipes.start_error.writing_end(), &error, sizeof error);
  ::_exit(127);
}

// errno if gnuplot did not start, else 0.
int start_error(const Pipe& pipe) {
  int error = 0;
  ssize_t n = 0;
  do {
    n = ::read(pipe.reading_end(), &error, sizeof error);
  } while (n < 0 && errno == EINTR);
  return n == static_cast<ssize_t>(sizeof error) ? error : 0;
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::max<long>(0, left.count()));
}

// Both at once, because a full pipe would stop the process that writes into it. Returns whether
// they ended before the deadline.
bool read_all(const Pipe& output, const Pipe& errors, GnuplotRun& run, Clock::time_point deadline) {
  std::array<pollfd, 2> streams{pollfd{output.reading_end(), POLLIN, 0},
                                pollfd{errors.reading_end(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&run.output, &run.errors};
  std::array<char, 1 << 14> buffer;
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (Clock::now() >= deadline) return false;
    if (::poll(streams.data(), streams.size(), milliseconds_until(deadline)) < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      const ssize_t n = ::read(streams[i].fd, buffer.data(), buffer.size());
      if (n > 0) texts[i]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) streams[i].fd = -1;  // which poll() skips
    }
  }
  return true;
}

// Whether the process ended before the deadline.
bool ends_until(Clock::time_point deadline, pid_t child, int& state) {
  while (true) {
    const pid_t ended = ::waitpid(child, &state, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return true;
    if (Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void kill_group(pid_t child, int& state) {
  ::kill(-child, SIGKILL);
  while (::waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
}

// Runs gnuplot in a directory, with its default settings: neither ~/.gnuplot nor the variables of
// the environment that gnuplot obeys have an effect. It is ended at the deadline, and with this
// process. No shell comes between, so that any name of a directory is only a name.
GnuplotRun run_gnuplot(const fs::path& directory, std::vector<std::string> arguments,
                       Clock::time_point deadline) {
  arguments.insert(arguments.begin(), {"gnuplot", "-d"});
  GnuplotRun run;
  Pipes pipes;
  const pid_t child = start(directory, arguments, pipes);
  if (child < 0) {
    run.start_error = errno;
    return run;
  }
  for (Pipe* pipe : {&pipes.output, &pipes.errors, &pipes.start_error}) pipe->close_writing_end();
  run.start_error = start_error(pipes.start_error);
  int state = 0;
  run.took_too_long =
      !read_all(pipes.output, pipes.errors, run, deadline) || !ends_until(deadline, child, state);
  if (run.took_too_long) kill_group(child, state);
  run.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  return run;
}

// --- drawings ------------------------------------------------------------------------------------

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
void draw(const fs::path& directory, const std::string& name, const char* ending,
          const std::string& terminal, std::chrono::milliseconds allowed, Clock::time_point end) {
  const std::string figure = name + ending;  // the directory is that of staged files
  const GnuplotRun gnuplot = run_gnuplot(
      directory, {"-e", fmt::format("set terminal {}; set encoding utf8", terminal), name + ".gp"},
      end);
  throw_if_not_started(figure, gnuplot.start_error);
  if (gnuplot.took_too_long) {
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
  for (const char* ending : endings) {
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
