// Derivatives of event times, and how far a strike can be predicted: scripts/study predictability.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "predictability/checks.h"

namespace {

using namespace subimpact::predictability;

struct Part {
  const char* name;
  bool (*check)(subimpact::Jobs);
};

constexpr Part parts[] = {{"table", check_table},   {"identities", check_identities},
                          {"merges", check_merges}, {"coverage", check_coverage},
                          {"cost", check_cost},     {"scatter", check_scatter}};

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Derivatives of event times, and how far a strike can be predicted.");
  std::vector<std::string> names, chosen;
  for (const Part& part : parts) names.emplace_back(part.name);
  subimpact::Jobs jobs = std::max(1u, std::thread::hardware_concurrency());
  program.add_option("PART", chosen, "Parts to run; all of them if none is named")
      ->check(CLI::IsMember(names));
  program.add_option("--jobs", jobs, "Runs beside one another at most");
  program.footer("Exit status: 0 every claim holds; 1 one does not.");
  CLI11_PARSE(program, argc, argv);
  bool all = true;
  for (const Part& part : parts) {
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), part.name) == chosen.end()) {
      continue;
    }
    fmt::print("\n## {}\n\n", part.name);
    all = part.check(jobs) && all;
  }
  return all ? 0 : 1;
}
