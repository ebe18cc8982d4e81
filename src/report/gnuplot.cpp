#include "report/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

#include "io/sealed_files.h"
#include "io/write_file.h"
#include "report/files.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

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

struct Finished {
  int start_error;  ///< errno if gnuplot could not be started, else 0
  int status;       ///< of its exit; minus the signal's number if one ended it
  std::string output, errors;
};

// Both at once, because a full pipe would stop the process that writes into it.
void read_all(Pipe& output, Pipe& errors, Finished& finished) {
  std::array<pollfd, 2> streams{pollfd{output.reading_end(), POLLIN, 0},
                                pollfd{errors.reading_end(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&finished.output, &finished.errors};
  std::array<char, 1 << 14> buffer;
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (::poll(streams.data(), streams.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      const ssize_t n = ::read(streams[i].fd, buffer.data(), buffer.size());
      if (n > 0) texts[i]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) streams[i].fd = -1;  // which poll() skips
    }
  }
}

// Runs gnuplot in a directory. No shell comes between, so that any name of a directory is only a
// name.
Finished run_gnuplot(const fs::path& directory, std::vector<std::string> arguments) {
  Pipe output, errors;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, output.writing_end(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.writing_end(), STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  arguments.insert(arguments.begin(), "gnuplot");
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  Finished finished{};
  finished.start_error =
      ::posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (finished.start_error != 0) return finished;
  output.close_writing_end();
  errors.close_writing_end();
  read_all(output, errors, finished);
  int state = 0;
  while (::waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  finished.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  return finished;
}

// gnuplot draws into a pipe, and the figure is written when it is complete.
void draw(const fs::path& directory, const std::string& name, const std::string& ending,
          const std::string& terminal) {
  const std::string figure = name + "." + ending;  // the directory is that of staged files
  const Finished gnuplot = run_gnuplot(
      directory, {"-e", fmt::format("set terminal {}; set encoding utf8", terminal), name + ".gp"});
  if (gnuplot.start_error == ENOENT) {
    throw GnuplotMissing(
        fmt::format("{}: cannot be drawn, because gnuplot is not installed; install it (Debian: "
                    "apt-get install gnuplot-nox) and repeat the command; the other files are "
                    "complete",
                    figure));
  }
  if (gnuplot.start_error != 0) {
    throw GnuplotMissing(fmt::format("{}: cannot be drawn, because gnuplot cannot be started ({})",
                                     figure, std::strerror(gnuplot.start_error)));
  }
  if (gnuplot.status != 0) {
    throw FigureError(fmt::format("{}: gnuplot failed with status {} on {}.gp: {}", figure,
                                  gnuplot.status, name, gnuplot.errors));
  }
  write_file(directory / figure, gnuplot.output);
}

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
  return file("style") + file("tables") + settings + file(name);
}

void draw_figure(const std::filesystem::path& directory, const std::string& name,
                 const std::string& script, FigureSize size) {
  for (const char* ending : {".svg", ".png", ".pdf"}) {  // of an earlier drawing
    std::error_code ignored;
    fs::remove(directory / (name + ending), ignored);
  }
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
  constexpr double pixels_per_inch = 96.0;
  draw(directory, name, "pdf",
       fmt::format("pdfcairo size {:.4f}in,{:.4f}in enhanced font 'sans,14' fontscale 0.75 "
                   "linewidth 1 pointscale 0.6 background rgb 'white'",
                   size.width / pixels_per_inch, size.height / pixels_per_inch));
}

}  // namespace subimpact
