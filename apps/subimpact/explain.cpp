#include <memory>

#include "commands.h"
#include "print.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/io/report.h"
#include "subimpact/study/companion.h"
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

}  // namespace subimpact::app
