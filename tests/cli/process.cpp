#include "process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace subimpact {

namespace fs = std::filesystem;

Finished run_program(const Words& arguments, const fs::path& working_directory, int interrupt_after,
                     int signal, unsigned long most_bytes) {
  const TemporaryDirectory streams;
  const std::string output = streams.path / "stdout";
  const std::string errors = streams.path / "stderr";
  Words words = {SUBIMPACT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    const int out = ::open(output.c_str(), O_WRONLY | O_CREAT, 0600);
    const int err = ::open(errors.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    const rlimit limit{most_bytes, most_bytes};
    if (most_bytes > 0) ::setrlimit(RLIMIT_FSIZE, &limit);
    if (::chdir(working_directory.c_str()) != 0) ::_exit(126);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  if (interrupt_after > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(interrupt_after));
    ::kill(child, signal);
  }
  int state = 0;
  rusage usage{};
  ::wait4(child, &state, 0, &usage);
  Finished finished;
  finished.megabytes = 1e-3 * static_cast<double>(usage.ru_maxrss);
  finished.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
  finished.output = read_file(output);
  finished.errors = read_file(errors);
  return finished;
}

}  // namespace subimpact
