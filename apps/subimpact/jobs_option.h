#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <thread>

#include "subimpact/study/companion.h"

namespace subimpact::app {

/// The option --jobs of commands that run several simulations.
struct JobsOption {
  Jobs given = 0;  ///< 0: not given

  void add_to(CLI::App& command) {
    command
        .add_option("--jobs", given,
                    "Runs beside one another at most; results do not depend on it. Default: the "
                    "number of processors")
        ->check(CLI::Range(1u, 1024u));
  }
  Jobs number() const {
    return given > 0 ? given : std::max(1u, std::thread::hardware_concurrency());
  }
};

}  // namespace subimpact::app
