#include <fmt/format.h>

#include <exception>

#include "commands.h"
#include "subimpact/io/results.h"
#include "subimpact/io/versions.h"

namespace {

std::string version_text() {
  std::string text = "subimpact " + subimpact::project_version();
  for (const auto& [name, version] : subimpact::library_versions()) {
    text += fmt::format("\n  {} {}", name, version);
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace subimpact;
  int status = app::done;
  CLI::App program("Finds every sub-impact when a rigid mass strikes an elasto-plastic beam.",
                   "subimpact");
  program.footer(
      "Examples:\n"
      "  subimpact explain case.toml\n"
      "  subimpact run case.toml --out out/first\n"
      "  subimpact run --help\n"
      "Exit status: 0 done, 2 bad command line or case file, 3 the solver failed.");
  program.set_version_flag("--version", version_text,
                           "Print the versions of program and libraries");
  program.require_subcommand(1);
  app::add_run(program, status);
  app::add_explain(program, status);
  app::add_methods(program, status);
  app::add_keys(program, status);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? app::done : app::refused;
  } catch (const CaseFileError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return app::refused;
  } catch (const OutputError& error) {
    fmt::print(stderr, "subimpact: {}\n", error.what());
    return app::refused;
  } catch (const std::exception& error) {
    fmt::print(stderr, "subimpact: {}\n", error.what());
    return app::failed;
  }
  return status;
}
