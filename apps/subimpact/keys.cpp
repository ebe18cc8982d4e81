#include <fmt/format.h>

#include "commands.h"
#include "subimpact/io/report.h"

namespace subimpact::app {

void add_keys(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "keys", "List the keys of a case file: units, allowed values, defaults");
  command->footer("Example:\n  subimpact keys");
  command->callback([&status] {
    fmt::print("{}", key_listing());
    status = done;
  });
}

}  // namespace subimpact::app
