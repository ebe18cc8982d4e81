// Commands that print and run nothing.

#include <memory>

#include "commands.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/io/report.h"
#include "subimpact/study/within.h"

namespace subimpact::app {

void add_explain(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "explain", "Show how a case will be modelled and what it will cost, without running it");
  auto options = std::make_shared<CaseOptions>();
  options->add_to(*command);
  command->footer(
      "Examples:\n"
      "  subimpact explain case.toml\n"
      "  subimpact explain case.toml --method central-difference --set model.segments=1001\n"
      "Exit status: 0 done; 2 bad command line or case file.");
  command->callback([options, &status] {
    const LoadedCase loaded = options->load();
    with_places(loaded, [&] {
      const OpenChoices open = open_choices(loaded.given);
      const bool chooses = open.all() || loaded.value.accuracy.event_times;
      const ChosenModel chosen =
          chooses ? first_choice(loaded.value, open) : ChosenModel{loaded.value, {}};
      ResolvedRun run = resolve(chosen.input);
      print_notes(loaded);
      print_warnings(doubtful_units(loaded.value));
      ResolvedSettings settings = run.settings();
      settings.memory = memory_with_companion(chosen.input, settings);
      print("{}", explanation(chosen.input, settings, estimate_cost(run)));
      if (chooses) print("Choice (of the first run; finer ones follow)\n  {}\n", chosen.reason);
    });
    status = done;
  });
}

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
