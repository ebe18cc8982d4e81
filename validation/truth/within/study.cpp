// Tolerances on event times, on random scenes, by run --within.
//
//   subimpact_within [--seed S] [--scenes N] [--budget seconds] [--work-limit W] [--jobs J]
//                    [--trace]

#include <CLI/CLI.hpp>

#include "within/judging.h"

int main(int argc, char** argv) {
  using namespace subimpact::wishes;
  CLI::App program("Tolerances on event times, on random scenes");
  WishStudy study;
  study.budget.seconds = 1.0;
  program.add_option("--seed", study.seed);
  program.add_option("--scenes", study.n_scenes);
  program.add_option("--budget", study.budget.seconds,
                     "Seconds of a run of four times as many cells");
  program.add_option("--work-limit", study.work_limit, "accuracy.work_limit of every request");
  program.add_option("--jobs", study.jobs,
                     "Scenes beside one another. Default: the cores there are");
  program.add_flag("--trace", study.trace, "Every run of every request on stderr");
  CLI11_PARSE(program, argc, argv);
  return study_wishes(study);
}
