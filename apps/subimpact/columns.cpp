#include "commands.h"
#include "print.h"
#include "subimpact/io/report.h"

namespace subimpact::app {

void add_columns(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "columns", "List the columns of the CSV tables that a run writes: units, meanings");
  command->footer("Example:\n  subimpact columns");
  command->callback([&status] {
    print("{}", column_listing());
    status = done;
  });
}

}  // namespace subimpact::app
