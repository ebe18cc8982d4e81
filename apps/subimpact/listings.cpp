#include <memory>

#include "commands.h"
#include "print.h"
#include "subimpact/io/case_schema.h"
#include "subimpact/io/report.h"

namespace subimpact::app {

void add_keys(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "keys", "List the keys of a case file: units, allowed values, defaults");
  const auto as_schema = std::make_shared<bool>(false);
  command->add_flag("--schema", *as_schema,
                    "Print a JSON schema (draft 2020-12) of the case file instead, for editors");
  command->footer(
      "Examples:\n  subimpact keys\n  subimpact keys --schema > subimpact.schema.json\n\n"
      "A case file that begins with `#:schema ./subimpact.schema.json` is then completed and\n"
      "checked by editors that use Taplo (in VS Code: the extension Even Better TOML).");
  command->callback([&status, as_schema] {
    print("{}", *as_schema ? case_schema() : key_listing());
    status = done;
  });
}

void add_methods(CLI::App& program, int& status) {
  CLI::App* command =
      program.add_subcommand("methods", "List the time integration methods and Butcher tables");
  command->footer("Example:\n  subimpact methods");
  command->callback([&status] {
    print("{}", method_listing());
    status = done;
  });
}

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
