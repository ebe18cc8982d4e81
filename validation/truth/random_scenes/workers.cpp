#include "random_scenes/workers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace subimpact::scenes {
namespace {

using Clock = std::chrono::steady_clock;

void write_all(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = write(file, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);
    data += n;
    size -= static_cast<std::size_t>(n);
  }
}

// The child's life: numbers of scenes in, records out.
[[noreturn]] void serve(int in, int out, double limit) {
  SceneId id;
  while (read(in, &id, sizeof id) == static_cast<ssize_t>(sizeof id)) {
    const std::string line = to_line(run_scene(id, limit)) + "\n";
    write_all(out, line.data(), line.size());
  }
  _exit(0);
}

class Worker {
 public:
  explicit Worker(double limit) : limit_(limit) { start(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    kill(child_, SIGTERM);  // its input stays open in workers forked later
    stop();
  }

  void give(const SceneId& id) {
    scene_ = id;
    busy_ = true;
    line_.clear();
    since_ = Clock::now();
    write_all(to_, reinterpret_cast<const char*>(&id), sizeof id);
  }

  bool busy() const { return busy_; }
  int output() const { return from_; }

  // After poll() said that there is something to read: whether the record is whole.
  bool read_some(Record& record) {
    std::array<char, 65536> buffer;
    const ssize_t n = read(from_, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) return false;
    if (n <= 0) {
      record = lost("crashed");
      return true;
    }
    line_.append(buffer.data(), static_cast<std::size_t>(n));
    if (line_.back() != '\n') return false;
    busy_ = false;
    record = from_line(line_);
    return true;
  }

  bool is_late() const {
    // A scene for counts takes up to five runs, and a busy machine its time.
    const double allowed = 60.0 + 12.0 * limit_;
    return busy_ && std::chrono::duration<double>(Clock::now() - since_).count() > allowed;
  }

  Record lost(const char* outcome) {
    if (!std::strcmp(outcome, "hung")) kill(child_, SIGKILL);
    const int status = stop();
    start();
    busy_ = false;
    Record record = describe(scene_, draw(scene_));
    record.outcome = outcome;
    const bool by_signal = WIFSIGNALED(status);
    record.message = fmt::format("process ended by {} {}", by_signal ? "signal" : "status",
                                 by_signal ? WTERMSIG(status) : WEXITSTATUS(status));
    record.failures.push_back({"no crash or hang", record.message});
    return record;
  }

 private:
  void start() {
    int down[2], up[2];
    if (pipe2(down, O_CLOEXEC) != 0 || pipe2(up, O_CLOEXEC) != 0) throw_error("pipe");
    std::fflush(nullptr);
    child_ = fork();
    if (child_ < 0) throw_error("fork");
    if (child_ == 0) {
      close(down[1]);
      close(up[0]);
      serve(down[0], up[1], limit_);
    }
    close(down[0]);
    close(up[1]);
    to_ = down[1];
    from_ = up[0];
  }

  int stop() {
    close(to_);
    close(from_);
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  [[noreturn]] static void throw_error(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
  }

  double limit_;
  pid_t child_ = -1;
  int to_ = -1, from_ = -1;
  bool busy_ = false;
  SceneId scene_;
  std::string line_;
  Clock::time_point since_;
};

}  // namespace

void run_scenes(const std::vector<SceneId>& scenes, int processes, double limit,
                const std::function<void(const Record&)>& done) {
  std::signal(SIGPIPE, SIG_IGN);
  std::vector<std::unique_ptr<Worker>> workers;
  for (int i = 0; i < processes; ++i) workers.push_back(std::make_unique<Worker>(limit));
  std::size_t next = 0, n_done = 0;
  while (n_done < scenes.size()) {
    std::vector<pollfd> files;
    for (auto& worker : workers) {
      if (!worker->busy() && next < scenes.size()) worker->give(scenes[next++]);
      files.push_back({worker->output(), static_cast<short>(worker->busy() ? POLLIN : 0), 0});
    }
    if (poll(files.data(), files.size(), 1000) < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    for (std::size_t i = 0; i < workers.size(); ++i) {
      Worker& worker = *workers[i];
      if (!worker.busy()) continue;
      Record record;
      const bool readable = (files[i].revents & (POLLIN | POLLHUP)) != 0;
      if (readable ? !worker.read_some(record) : !worker.is_late()) continue;
      if (!readable) record = worker.lost("hung");
      ++n_done;
      done(record);
    }
  }
}

}  // namespace subimpact::scenes
