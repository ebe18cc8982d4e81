#include "commands.h"

namespace subimpact::app {

void CaseOptions::add_to(CLI::App& command) {
  command.add_option("CASE", file, "Case file (TOML); `subimpact keys` lists what it may hold")
      ->required();
  command.add_option("--method", method,
                     "Time integration method, in place of the case's; see `subimpact methods`");
  command
      .add_option("--set", settings,
                  "table.key=value, in place of what the case says; may be repeated")
      ->allow_extra_args(false);
}

LoadedCase CaseOptions::load() const {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  if (!method.empty()) overrides.push_back({"solver.method", method, "--method " + method});
  return read_case_file(file, overrides);
}

}  // namespace subimpact::app
