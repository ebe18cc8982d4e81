#include "report/gnuplot.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

#include "io/sealed_files.h"
#include "report/files.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// What a process of gnuplot left behind.
struct GnuplotRun {
  int start_error = 0;         ///< errno if gnuplot could not be started, else 0
  int status = 0;              ///< of its exit; minus the signal's number if one ended it
  bool took_too_long = false;  ///< and was ended
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

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

// Between fork() and exec: nothing here takes memory or a lock. Returns errno.
int become_gnuplot(const char* directory, char* const* arguments, char* const* variables,
                   int output, int errors) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
      ::dup2(errors, STDERR_FILENO) < 0 || ::chdir(directory) != 0) {
    return errno;
  }
  ::execvpe(arguments[0], arguments, variables);
  return errno;
}

// A group of its own, so that what gnuplot starts can be ended with it. Returns -1 if no process
// can be made. What cannot be started leaves errno in the file `start_error`.
pid_t start(const fs::path& directory, std::vector<std::string>& words, int output, int errors,
            int start_error) {
  const std::vector<char*> arguments = pointers(words);
  const std::vector<char*> variables = environment();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // it ended before it could take this process with it
  const int error =
      become_gnuplot(directory.c_str(), arguments.data(), variables.data(), output, errors);
  [[maybe_unused]] const ssize_t n = ::write(start_error, &error, sizeof error);
  ::_exit(127);
}

// Appends what can be read to a text. Returns whether that ended before the deadline.
bool read_until(Clock::time_point deadline, int file, std::string& text) {
  std::array<char, 1 << 14> buffer;
  for (ssize_t n = 1; n != 0;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd stream{file, POLLIN, 0};
    if (left.count() <= 0) return false;
    if (::poll(&stream, 1, static_cast<int>(left.count())) <= 0) continue;  // or a signal came
    n = ::read(file, buffer.data(), buffer.size());
    if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
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
  std::array<int, 2> ends{-1, -1};
  const int failed = ::pipe2(ends.data(), O_CLOEXEC);
  const Descriptor output(failed == 0 ? ends[0] : -1);
  auto input = std::make_unique<Descriptor>(ends[1]);
  const Descriptor errors(make_memory_file()), start_error(make_memory_file());
  GnuplotRun run;
  const pid_t child = start(directory, arguments, *input, errors, start_error);
  if (child < 0) {
    run.start_error = errno;
    return run;
  }
  input.reset();  // the end of the output is that of gnuplot
  int state = 0;
  run.took_too_long =
      !read_until(deadline, output, run.output) || !ends_until(deadline, child, state);
  if (run.took_too_long) kill_group(child, state);
  run.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  run.errors.resize(static_cast<std::size_t>(::lseek(errors, 0, SEEK_END)));
  if (::pread(errors, run.errors.data(), run.errors.size(), 0) < 0 ||
      ::pread(start_error, &run.start_error, sizeof run.start_error, 0) < 0) {
    throw std::system_error(errno, std::generic_category(), "a file for gnuplot");
  }
  return run;
}

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
