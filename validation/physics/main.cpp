// Runs validation cases and sets their numbers beside published ones.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "outcome.h"

namespace {

using namespace subimpact::validation;

struct Named {
  const char* name;
  Outcome (*check)();
};

const Named cases[] = {{"paper", check_paper},
                       {"paper/as_computed", check_paper_as_computed},
                       {"timoshenko", check_timoshenko},
                       {"rigid_bodies", check_rigid_bodies},
                       {"contact_tests", check_contact_tests},
                       {"damped_contact", check_damped_contact},
                       {"scenes", check_scenes},
                       {"sdnl32", check_sdnl32},
                       {"long_beam", check_long_beam},
                       {"shear", check_shear},
                       {"spectral_identity", check_spectral_identity},
                       {"frequencies", check_frequencies},
                       {"glued_mass", check_glued_mass},
                       {"contact", check_contact},
                       {"bending", check_bending},
                       {"rigid_plastic", check_rigid_plastic},
                       {"repeated_strikes", check_repeated_strikes},
                       {"conservation", check_conservation}};

constexpr const char* begin_mark = "<!-- results: written by scripts/study physics --update -->\n";
constexpr const char* end_mark = "<!-- end of results -->";

// Replaces what stands between the marks of a page.
void renew(const std::string& path, const std::string& content) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  std::string page = text.str();
  const auto begin = page.find(begin_mark);
  const auto end = page.find(end_mark);
  if (!in || begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error(path + ": has no results section to renew");
  }
  const auto from = begin + std::string(begin_mark).size();
  page.replace(from, end - from, "\n" + content + "\n");
  std::ofstream(path) << page;
}

std::string notes_of(const Outcome& outcome) {
  std::string text;
  for (const std::string& note : outcome.notes) text += "\n" + note + "\n";
  return text;
}

int run(const std::vector<std::string>& chosen, bool update) {
  std::string all = table_head(true);
  fmt::print("{}", all);
  int n_rows = 0, n_agree = 0, n_fail = 0;
  for (const auto& [name, check] : cases) {
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), name) == chosen.end()) continue;
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = check();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const std::string rows = table(outcome, name);
    fmt::print("{}", rows);
    std::fflush(stdout);
    fmt::print(stderr, "{}: {:.1f} s\n", name, taken.count());
    all += rows;
    for (const Row& row : outcome.rows) {
      ++n_rows;
      n_agree += row.agrees();
      n_fail += row.fails();
    }
    if (update) {
      renew(fmt::format("{}/{}/README.md", SUBIMPACT_VALIDATION, name),
            table_head(false) + table(outcome) + notes_of(outcome));
    } else if (chosen.size() == 1) {
      fmt::print("{}", notes_of(outcome));
    }
  }
  const std::string sum =
      fmt::format("{} of {} quantities agree; {} differ for stated reasons, {} fail.", n_agree,
                  n_rows, n_rows - n_agree - n_fail, n_fail);
  fmt::print("\n{}\n", sum);
  if (update && chosen.empty()) {
    renew(std::string(SUBIMPACT_VALIDATION) + "/../README.md", all + "\n" + sum + "\n");
  }
  return n_fail == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Runs validation cases and sets their numbers beside published ones.");
  std::vector<std::string> chosen;
  std::vector<std::string> names;
  for (const Named& one : cases) names.emplace_back(one.name);
  bool update = false;
  program.add_option("CASE", chosen, "Cases to run; all of them if none is named")
      ->check(CLI::IsMember(names));
  program.add_flag("--update", update, "Write the outcome into the pages of validation/");
  program.footer("Exit status: 0 every quantity agrees or differs for a stated reason; 1 not so.");
  CLI11_PARSE(program, argc, argv);
  try {
    return run(chosen, update);
  } catch (const std::exception& error) {
    fmt::print(stderr, "subimpact_validate: {}\n", error.what());
    return 1;
  }
}
