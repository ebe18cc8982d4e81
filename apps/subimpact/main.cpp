#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#include "commands.h"
#include "numerics/lanes.h"

namespace {

// Whether standard output is a pipe whose reader has ended.
bool is_reader_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

// Ends the program as other programs end whose reader has left: `subimpact keys | head`.
void end_by_broken_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

// Output that was lost is a failure of the command.
int checked_output(int status) {
  using namespace subimpact;
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  const int cause = errno;
  if (flushed && std::cout.flush()) return status;
  if (is_reader_gone()) end_by_broken_pipe();
  app::print_error(
      "subimpact: standard output cannot be written ({}); free the disk or write the output "
      "elsewhere\n",
      cause != 0 ? std::strerror(cause) : "only a part could be written");
  return status == app::done ? app::failed : status;
}

// A file of the program that took the number of a closed standard stream would receive what is
// printed. The stream gets a place that refuses it in its stead: printing then fails as it should.
bool occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const int refusing = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", refusing) != stream) return false;
  }
  return true;
}

int run(int argc, char** argv) {
  using namespace subimpact;
  std::signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit fails then, like writing to a full disk
  std::signal(SIGPIPE, SIG_IGN);  // results come before what is printed, and notes before a run
  try {
    std::vector<app::Command> commands = {app::new_command(),       app::run_command(),
                                          app::compare_command(),   app::work_precision_command(),
                                          app::stability_command(), app::explain_command(),
                                          app::report_command()};
    for (auto& list : {app::python_commands(), app::listing_commands()}) {
      commands.insert(commands.end(), list.begin(), list.end());
    }
    return checked_output(app::run_command_line(argc, argv, commands));
  } catch (const Error& error) {
    const bool names_file = error.kind == ErrorKind::case_file || error.kind == ErrorKind::results;
    app::print_error("{}{}\n", names_file ? "" : "subimpact: ", error.what());
    return error.kind == ErrorKind::invalid_case ? app::failed : app::refused;
  } catch (const std::bad_alloc&) {
    app::print_error(
        "subimpact: the memory does not suffice; `subimpact explain` shows what a case takes: use "
        "a coarser mesh, or raise the limit of memory\n");
  } catch (const std::exception& error) {
    app::print_error("subimpact: {}\n", error.what());
  }
  return app::failed;
}

}  // namespace

int main(int argc, char** argv) {
  if (!occupy_closed_streams()) return subimpact::app::failed;
  if (!subimpact::is_processor_sufficient()) {
    std::fputs(subimpact::insufficient_processor, stderr);
    return subimpact::app::failed;
  }
  try {
    return run(argc, argv);
  } catch (...) {  // while a message was made
    std::fputs("subimpact: no memory is left for a message\n", stderr);
    return subimpact::app::failed;
  }
}
