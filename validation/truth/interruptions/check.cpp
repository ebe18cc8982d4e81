// Runs the program into one directory over and over, kills it, fills its disk, tells it to end and
// runs two at once, and reads what lies in the directory after each: see README.md.

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/directory/listed_files.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The paper's strike on few elastic cells: most of the time goes into writing.
const std::vector<std::string> settings = {"model.segments=41", "model.section=elastic",
                                           "solver.method=exponential", "output.interval=1e-7",
                                           "output.sections=0.5"};

// Runs that can be told apart: each ends at another time.
constexpr int n_variants = 100;
double end_of(int variant) { return 4e-4 + 1e-6 * variant; }

struct Ended {
  int status = 0;  // minus the signal's number if one ended the process
  std::string output, errors;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class Process {
 public:
  Process(const fs::path& place, const fs::path& out, int variant,
          const std::map<std::string, std::string>& environment = {})
      : streams_(place / fmt::format("streams-{}", variant)) {
    fs::create_directories(streams_);
    std::vector<std::string> words = {"subimpact", "run", SUBIMPACT_PAPER_CASE, "--out", out};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    words.insert(words.end(), {"--set", fmt::format("time.end={}", end_of(variant))});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    redirect(streams_ / "out", STDOUT_FILENO);
    redirect(streams_ / "err", STDERR_FILENO);
    ::execv(SUBIMPACT_PROGRAM, argv.data());
    ::_exit(127);
  }

  void send(int signal) const { ::kill(child_, signal); }

  Ended wait() {
    int state = 0;
    ::waitpid(child_, &state, 0);
    Ended ended{WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state), text_of(streams_ / "out"),
                text_of(streams_ / "err")};
    fs::remove_all(streams_);
    return ended;
  }

 private:
  static void redirect(const fs::path& file, int stream) {
    ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
  }

  fs::path streams_;
  pid_t child_ = 0;
};

class Interruptions {
 public:
  Interruptions(fs::path place, unsigned seed) : place_(std::move(place)), random_(seed) {
    fs::remove_all(place_);
    fs::create_directories(place_);
    const auto start = Clock::now();
    run(0);
    duration_ = Clock::now() - start;
    if (found() != 0) throw std::runtime_error("a run that was left alone has no results");
  }

  void kills(int n) {
    const Tally tally(*this, "kill -9 at a random instant", n);
    for (int i = 0; i < n; ++i) {
      const int before = found();
      const int next = next_variant();
      Process process(place_, out(), next);
      pause();
      process.send(SIGKILL);
      process.wait();
      const int after = found();
      n_older_ += after == before;
      n_newer_ += after == next;
      expect(after == before || after == next, fmt::format("killed run {}", next));
    }
  }

  void requests(int n) {
    const Tally tally(*this, "TERM, HUP or INT at a random instant", n);
    for (int i = 0; i < n; ++i) {
      const int signal = std::vector<int>{SIGTERM, SIGHUP, SIGINT}[random_() % 3];
      const int before = found();
      const int next = next_variant();
      Process process(place_, out(), next);
      pause();
      process.send(signal);
      const Ended ended = process.wait();
      const int after = found();
      n_older_ += after == before;
      n_newer_ += after == next;
      // Before the run begins and when all is done a signal ends the process as usual.
      const bool was_listening = ended.status >= 0;
      expect(after == next || (!was_listening && after == before),
             fmt::format("run {} told to end", next));
      expect(!was_listening || ended.status == 0 || ended.status == 128 + signal,
             fmt::format("status {} after signal {}", ended.status, signal));
    }
  }

  void full_disks(int n) {
    const Tally tally(*this, "no space from a random call on", n);
    for (int i = 0; i < n; ++i) {
      const int before = found();
      const int next = next_variant();
      const Ended ended = Process(place_, out(), next,
                                  {{"LD_PRELOAD", SUBIMPACT_NO_SPACE},
                                   {"NO_SPACE_FROM", fmt::format("{}", 1 + random_() % 30)},
                                   {"NO_SPACE_UNDER", out()}})
                              .wait();
      const int after = found();
      n_older_ += after == before;
      n_newer_ += after == next;
      expect(after == before || after == next, fmt::format("run {} on a full disk", next));
      if (ended.status == 0) {
        expect(after == next, "status 0 without results");
      } else if (ended.status == 3) {
        expect(ended.output.find("zone 1") != std::string::npos, "status 3 without printed rows");
      } else {
        expect(ended.status == 2 && after == before, fmt::format("status {}", ended.status));
      }
    }
  }

  void pairs(int n) {
    const Tally tally(*this, "pairs of runs into one directory", n);
    for (int i = 0; i < n; ++i) {
      const int before = found();
      const int a = next_variant();
      const int b = next_variant();
      Process first(place_, out(), a);
      std::this_thread::sleep_for(duration_ * (0.5 * std::generate_canonical<double, 53>(random_)));
      Process second(place_, out(), b);
      const Ended one = first.wait();
      const Ended other = second.wait();
      const int after = found();
      n_older_ += after == before;
      n_newer_ += after == a || after == b;
      expect((after == a && one.status == 0) || (after == b && other.status == 0),
             fmt::format("pair {} (status {}) and {} (status {})", a, one.status, b, other.status));
      for (const Ended& ended : {one, other}) {
        expect(ended.status == 0 ||
                   (ended.status == 2 && ended.errors.find("is writing into") != std::string::npos),
               fmt::format("status {}: {}", ended.status, ended.errors));
      }
    }
  }

  int n_failed() const { return n_failed_; }

 private:
  // Prints a line at its end.
  class Tally {
   public:
    Tally(Interruptions& study, std::string what, int n)
        : study_(study), what_(std::move(what)), n_(n), failed_(study.n_failed_) {
      study_.n_older_ = study_.n_newer_ = 0;
    }
    ~Tally() {
      fmt::print("{:<52} {:>5}   older {:>4}   newer {:>4}   wrong {:>3}\n", what_, n_,
                 study_.n_older_, study_.n_newer_, study_.n_failed_ - failed_);
      std::fflush(stdout);
    }
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;

   private:
    Interruptions& study_;
    std::string what_;
    int n_, failed_;
  };

  fs::path out() const { return place_ / "out"; }
  int next_variant() { return 1 + n_runs_++ % (n_variants - 1); }
  void run(int variant) { Process(place_, out(), variant).wait(); }
  void pause() {
    const double share = 1.3 * std::generate_canonical<double, 53>(random_);
    std::this_thread::sleep_for(duration_ * share);
  }

  void expect(bool holds, const std::string& what) {
    if (holds) return;
    ++n_failed_;
    fmt::print("WRONG: {}\n", what);
  }

  // A file as a reader finds it: the one that the manifest lists, in its place or, if that is still
  // to come, under the name of its commit.
  static std::string listed_text(const fs::path& directory, const std::string& name) {
    const Manifest manifest = read_manifest(directory).value();
    const fs::path path = directory / name;
    for (const fs::path& place : {path, staging_of(directory, manifest.commit) / name, path}) {
      std::error_code ignored;
      if (!fs::exists(place, ignored)) continue;
      std::istringstream text(read_whole_file(place));
      if (fingerprint_of(text) == manifest.files.at(name)) return text.str();
    }
    throw std::runtime_error(path.string() + " is not the file that the manifest lists");
  }

  // Which run's results a reader finds in a directory. What it finds must be whole. Throws.
  int variant_in(const fs::path& directory) {
    const auto summary = nlohmann::json::parse(listed_text(directory, "summary.json"));
    const std::size_t n_rows = summary.at("counts").at("history_rows");
    for (const char* table : {"history.csv", "sections.csv"}) {
      const std::string text = listed_text(directory, table);
      const auto n = static_cast<std::size_t>(std::ranges::count(text, '\n'));
      expect(n == 1 + n_rows, fmt::format("{} rows of {} in {}", n, 1 + n_rows, table));
      const double last = std::stod(text.substr(text.rfind('\n', text.size() - 2) + 1));
      expect(last == summary.at("outcome").at("time_s"), "the last row is not that of the end");
    }
    for (int variant = 0; variant < n_variants; ++variant) {
      if (summary.at("case").at("time").at("end") == end_of(variant)) return variant;
    }
    expect(false, "results of no run");
    return -1;
  }

  // In the directory of the runs; -1: none.
  int found() {
    try {
      return variant_in(out());
    } catch (const std::exception& error) {
      expect(false, fmt::format("refused: {}", error.what()));
      return -1;
    }
  }

  fs::path place_;
  std::mt19937 random_;
  std::chrono::duration<double> duration_{};
  int n_runs_ = 0;
  int n_failed_ = 0;
  int n_older_ = 0, n_newer_ = 0;
};

}  // namespace
}  // namespace subimpact

int main(int argc, char** argv) {
  CLI::App program("Interrupts runs into one directory and reads what lies there");
  std::string place = (std::filesystem::temp_directory_path() / "subimpact-interruptions").string();
  unsigned seed = 1;
  int kills = 500, full_disks = 200, pairs = 100, requests = 100;
  program.add_option("--place", place, "Directory for the runs, removed at first")
      ->capture_default_str();
  program.add_option("--seed", seed)->capture_default_str();
  program.add_option("--kills", kills)->capture_default_str();
  program.add_option("--full-disks", full_disks)->capture_default_str();
  program.add_option("--pairs", pairs)->capture_default_str();
  program.add_option("--requests", requests)->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  subimpact::Interruptions study(std::filesystem::absolute(place), seed);
  study.kills(kills);
  study.full_disks(full_disks);
  study.pairs(pairs);
  study.requests(requests);
  return study.n_failed() == 0 ? 0 : 1;
}
