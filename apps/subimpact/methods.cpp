#include "commands.h"
#include "print.h"
#include "subimpact/io/report.h"

namespace subimpact::app {

void add_methods(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("methods", "List the time integration methods and Butcher tables");
  command->footer("Example:\n  subimpact methods");
  command->callback([&status] {
    print("{}", method_listing());
    status = done;
  });
}

}  // namespace subimpact::app
