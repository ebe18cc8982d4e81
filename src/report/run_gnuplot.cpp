#include "report/run_gnuplot.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <thread>

namespace subimpact {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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

}  // namespace

// No shell comes between, so that any name of a directory is only a name.
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

}  // namespace subimpact
