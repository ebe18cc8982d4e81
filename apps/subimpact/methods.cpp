#include <fmt/format.h>

#include "commands.h"
#include "subimpact/io/report.h"

namespace subimpact::app {

void add_methods(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("methods", "List the time integration methods and Butcher tables");
  command->footer("Example:\n  subimpact methods");
  command->callback([&status] {
    fmt::print("{}", method_listing());
    status = done;
  });
}

}  // namespace subimpact::app
