// Random scenes: whether what the program says of them holds, and whether wrong counts are flagged.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "random_scenes/tables.h"
#include "random_scenes/workers.h"

namespace {

using namespace subimpact::scenes;

struct Options {
  int scenes = 3000;
  int count_scenes = 500;
  int key_scenes = 500;
  int first = 0;
  std::uint64_t seed = 1;
  int jobs = 2;
  double limit = 10.0;  // s
  bool slice = false;
  bool update = false;
  std::optional<int> write;
  Purpose of = Purpose::checks;  // the scene to write
  std::string out;
};

constexpr const char* begin_mark =
    "<!-- results: written by scripts/study random_scenes --update -->\n";
constexpr const char* end_mark = "<!-- end of results -->";

void renew_page(const std::string& content) {
  const std::string path = std::string(SUBIMPACT_RANDOM_SCENES) + "/README.md";
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  std::string page = text.str();
  const auto begin = page.find(begin_mark);
  const auto end = page.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error(path + ": has no results section to renew");
  }
  const auto from = begin + std::string(begin_mark).size();
  page.replace(from, end - from, "\n" + content + "\n");
  std::ofstream(path) << page;
}

std::vector<SceneId> scenes_of(const Options& options) {
  std::vector<SceneId> scenes;
  const auto add = [&](int n, Purpose purpose) {
    for (int i = 0; i < n; ++i) scenes.push_back({options.seed, options.first + i, purpose});
  };
  add(options.scenes, options.slice ? Purpose::slice : Purpose::checks);
  add(options.count_scenes, Purpose::counts);
  add(options.key_scenes, Purpose::scene_keys);
  return scenes;
}

std::vector<Record> run(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<SceneId> scenes = scenes_of(options);
  std::vector<Record> records;
  int n_failed = 0;
  run_scenes(scenes, options.jobs, options.limit, [&](const Record& record) {
    records.push_back(record);
    n_failed += !record.failures.empty();
    if (records.size() % 50 != 0 && records.size() != scenes.size()) return;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    fmt::print(stderr, "{} of {} scenes, {} with a check that fails, {:.0f} s\n", records.size(),
               scenes.size(), n_failed, taken.count());
  });
  std::sort(records.begin(), records.end(), [](const Record& a, const Record& b) {
    return std::pair(a.id.purpose, a.id.number) < std::pair(b.id.purpose, b.id.number);
  });
  return records;
}

int report(const Options& options, const std::vector<Record>& records) {
  const std::string tables = outcome_tables(records);
  const std::string failures = failure_list(records);
  fmt::print("{}\n{}", failures, tables);
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    std::ofstream(options.out + "/scenes.csv") << csv(records);
    std::ofstream(options.out + "/failures.txt") << failures;
  }
  if (options.update) renew_page(tables);
  return all_hold(records) ? 0 : 1;
}

int write_case(const Options& options) {
  fmt::print("{}", case_text(draw({options.seed, *options.write, options.of}).input));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Runs random scenes and checks whatever must hold of a result.");
  Options options;
  program.add_option("--scenes", options.scenes, "Scenes that are run once")->capture_default_str();
  program.add_option("--count-scenes", options.count_scenes, "Scenes whose counts are checked")
      ->capture_default_str();
  program
      .add_option("--key-scenes", options.key_scenes,
                  "Scenes with gravity, stops, loads, springs, whose counts are checked")
      ->capture_default_str();
  program.add_option("--first", options.first, "Number of the first scene")->capture_default_str();
  program.add_option("--seed", options.seed, "Seed")->capture_default_str();
  program.add_option("--jobs", options.jobs, "Processes")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  program.add_option("--limit", options.limit, "Wall clock of a run, s")->capture_default_str();
  program.add_option("--out", options.out, "Directory for scenes.csv and failures.txt");
  program.add_flag("--slice", options.slice, "Cheaper scenes, for the tests");
  program.add_flag("--update", options.update,
                   "Write the outcome into validation/truth/random_scenes/");
  program.add_option("--write", options.write, "Print this scene's case file and run nothing");
  const auto of_word = [](const std::string& word) {
    for (const Purpose purpose : {Purpose::checks, Purpose::counts, Purpose::scene_keys}) {
      if (word == to_string(purpose)) return purpose;
    }
    return Purpose::slice;
  };
  program
      .add_option_function<std::string>(
          "--of", [&](const std::string& word) { options.of = of_word(word); },
          "With --write: of which scenes")
      ->check(CLI::IsMember({"checks", "counts", "keys", "slice"}));
  program.footer("Exit status: 0 every check holds; 1 not so.");
  CLI11_PARSE(program, argc, argv);
  try {
    return options.write ? write_case(options) : report(options, run(options));
  } catch (const std::exception& error) {
    fmt::print(stderr, "random-scenes: {}\n", error.what());
    return 2;
  }
}
