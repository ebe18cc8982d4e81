#include "commands.h"
#include "subimpact/report/studies.h"

namespace subimpact::app {
namespace {

struct StabilityCommand : StudyOptions {
  std::vector<std::string> parts;
  double run_seconds = 20.0;
};

struct Part {
  const char* name;
  const char* title;
  std::function<StabilityPart()> run;
};

std::vector<Part> parts_of(const Case& input, const StabilityCommand& command,
                           StudySession& session) {
  const auto counter = [&session](const char* what) -> Count {
    return [&session, what](std::size_t n, std::size_t all) {
      session.status.show(fmt::format("{}: {} of {}", what, n, all));
      return !session.listener.interrupted();
    };
  };
  return {
      {"map", "Outcomes of runs of the case",
       [=, &input, &command] {
         return part_of(outcome_map(input, command.methods, command.run_seconds, command.jobs,
                                    counter("runs")));
       }},
      {"pairs", "Sub-impacts within one step, elastic beam at several speeds",
       [=, &input, &command] {
         return asked_for(command.methods, "exponential")
                    ? part_of(missed_pairs(input, command.jobs, counter("strikes")))
                    : StabilityPart();
       }},
      {"layers", "Layers against the exact section",
       [=, &input, &command] {
         return part_of(layers_against_exact(input, command.jobs, counter("numbers of layers")));
       }},
  };
}

// A part that fails leaves the others as they are: false, with a message.
bool run_part(const Part& part, const std::filesystem::path& directory, StatusLine& status) {
  std::string failure;
  try {
    const StabilityPart result = part.run();
    if (result.text.empty()) return true;
    status.clear();
    print("{}\n\n{}\n", part.title, result.text);
    std::fflush(stdout);
    write(directory, result);
    return true;
  } catch (const InvalidCase& error) {
    failure = error.key + " " + error.what();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  status.clear();
  print_error("subimpact: {}: {}\n", part.name, failure);
  return false;
}

// All parts but the map let the beam vibrate.
void check_beam(const Case& input, const std::vector<std::string>& parts) {
  if (input.model.mesh != MeshKind::rigid || parts == std::vector<std::string>{"map"}) return;
  throw InvalidCase("model.mesh",
                    "is \"rigid\", but a rigid beam has no vibrations to study; use another mesh, "
                    "or --parts map");
}

int run_stability(StabilityCommand& command) {
  const LoadedCase loaded = command.input.load();
  print_doubts(loaded);
  if (command.directory.empty()) command.directory = command.input.directory_with("-stability");
  return with_places(loaded, [&]() -> int {
    check_methods(loaded.value, command.methods);
    StudySession session;
    const std::vector<Part> parts = parts_of(loaded.value, command, session);
    check_beam(loaded.value, command.parts);
    OutputDirectory directory(command.directory, "stability", case_id(loaded.value));
    bool all_done = true;
    for (const Part& part : parts) {
      if (!asked_for(command.parts, part.name)) continue;
      if (session.listener.interrupted()) break;
      session.status.show(part.name);
      if (!run_part(part, directory.staging(), session.status)) all_done = false;
      try {
        directory.commit();
      } catch (const OutputError& error) {
        print_error("subimpact: {}\n", error.what());
        return failed;
      }
    }
    print("CSV files in {0}; subimpact plot {0} draws them\n", command.directory);
    if (!session.listener.interrupted()) return all_done ? done : failed;
    return session.end_interrupted("; the parts that were finished are in " + command.directory);
  });
}

std::vector<Option> options_of(StabilityCommand& options) {
  return options.input.of_case() +
         std::vector<Option>{
             {"--methods", &options.methods,
              "Only these methods, separated by commas; one without a table stands for all "
              "its tables. Default: all"},
             {"--parts",
              &options.parts,
              "Only these parts, separated by commas: map (right, wrong count, inaccurate, "
              "unstable, refused, failed), pairs (sub-impacts within one step), layers (against "
              "the exact section)",
              {},
              {"map", "pairs", "layers"}},
             of_directory(options.directory,
                          "Directory for CSV files; made if missing. Default: the case file's "
                          "name without its ending, and -stability, in the current directory"),
             of_seconds("--run-seconds", options.run_seconds,
                        "Runs of the map that take longer are left out"),
             of_jobs(options.jobs)};
}

}  // namespace

Command stability_command() {
  return command_with(
      "stability", "Find where each method fails, and how; as tables and CSV", run_stability,
      options_of,
      "Parts are printed and written one by one; after Ctrl-C the finished parts remain.\n"
      "Examples:\n"
      "  subimpact stability case.toml --out out/stability; subimpact plot out/stability\n"
      "  subimpact stability case.toml --parts map,pairs --methods central-difference,exponential\n"
      "  subimpact stability case.toml --parts map --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a part failed, the other parts are "
      "complete; 130 stopped by Ctrl-C.");
}

}  // namespace subimpact::app
