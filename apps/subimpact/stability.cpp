#include "print.h"
#include "subimpact/report/studies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "commands.h"
#include "interrupt.h"
#include "status_line.h"
#include "subimpact/io/results.h"
#include "subimpact/io/work_precision.h"

namespace subimpact::app {
namespace {

struct StabilityCommand {
  CaseOptions input;
  std::vector<std::string> methods;
  std::vector<std::string> parts;
  std::string directory;
  double run_seconds = 20.0;
};

struct Part {
  const char* name;
  const char* title;
  std::function<void()> run;
};

class Session {
 public:
  Session(const Case& input, const StabilityCommand& command) : input_(input), command_(command) {
    parts_ = {
        {"critical", "Explicit methods: largest stable step, elastic beam", [&] { critical(); }},
        {"contact", "Central differences: largest stable step in stiff contact",
         [&] { contact(); }},
        {"damping", "Implicit methods: what one step leaves of an oscillation", [&] { damping(); }},
        {"map", "How runs of the case come out", [&] { map(); }},
        {"pairs", "Sub-impacts within one step, elastic beam at several speeds", [&] { pairs(); }},
        {"layers", "Layers against the exact section", [&] { layers(); }},
    };
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const Part& part : parts_) list.push_back(part.name);
    return list;
  }

  int run() {
    directory_.emplace(command_.directory, "stability", case_id(input_));
    for (const Part& part : parts_) {
      if (!asked_for(command_.parts, part.name)) continue;
      if (listener_.interrupted()) break;
      status_.show(part.name);
      run(part);
      directory_->commit();
    }
    print_warnings(directory_->notes());
    app::print("CSV files and figures in {}\n", command_.directory);
    if (!listener_.interrupted()) return all_done_ ? done : failed;
    app::print_error("subimpact: interrupted; the parts that were finished are in {}\n",
                     command_.directory);
    return listener_.exit_status();
  }

 private:
  void complain(const Part& part, const std::string& message) {
    status_.clear();
    app::print_error("subimpact: {}: {}\n", part.name, message);
    all_done_ = false;
  }
  // A part that fails leaves the others as they are.
  void run(const Part& part) {
    try {
      part.run();
      return;
    } catch (const InvalidCase& error) {
      complain(part, error.key + " " + error.what());
    } catch (const std::exception& error) {
      complain(part, error.what());
    }
  }
  void print(std::size_t part, const std::string& table) {
    status_.clear();
    app::print("{}\n\n{}\n", parts_[part].title, table);
    std::fflush(stdout);
  }
  Count counter(const char* what) {
    return [this, what](std::size_t n, std::size_t all) {
      status_.show(fmt::format("{}: {} of {}", what, n, all));
      return !listener_.interrupted();
    };
  }

  void critical() {
    const auto rows = critical_steps(input_, command_.methods);
    if (rows.empty()) return;
    print(0, critical_step_table(rows));
    write_critical_steps(directory_->staging(), rows);
  }
  void contact() {
    if (!asked_for(command_.methods, "central-difference")) return;
    const auto rows = stiff_contact(input_);
    print(1, stiff_contact_table(rows));
    write_stiff_contact(directory_->staging(), rows);
  }
  void damping() {
    if (!asked_for(command_.methods, "dirk") && !asked_for(command_.methods, "bdf")) return;
    const auto rows = damping_of_implicit_tables(input_);
    print(2, damping_table(rows));
    write_damping(directory_->staging(), rows, bdf_growths());
  }
  void map() {
    const OutcomeMap result =
        outcome_map(input_, command_.methods, command_.run_seconds, counter("runs"));
    print(3, outcome_table(result));
    write_outcomes(directory_->staging(), result);
  }
  void pairs() {
    if (!asked_for(command_.methods, "exponential")) return;
    const auto rows = missed_pairs(input_, counter("strikes"));
    print(4, missed_pairs_table(rows));
    write_missed_pairs(directory_->staging(), rows);
  }
  void layers() {
    const LayerStudy study = layers_against_exact(input_, counter("numbers of layers"));
    print(5, layer_table(study));
    write_layers(directory_->staging(), study);
  }

  const Case& input_;
  const StabilityCommand& command_;
  std::optional<OutputDirectory> directory_;
  std::vector<Part> parts_;
  bool all_done_ = true;
  InterruptListener listener_;
  StatusLine status_;
};

// All parts but the map let the beam vibrate.
void check_beam(const Case& input, const std::vector<std::string>& parts) {
  if (input.model.mesh != MeshKind::rigid || parts == std::vector<std::string>{"map"}) return;
  throw InvalidCase("model.mesh",
                    "is \"rigid\", but a rigid beam has no vibrations to study; use another mesh, "
                    "or --parts map");
}

int run_stability(StabilityCommand command) {
  const LoadedCase loaded = command.input.load();
  if (command.directory.empty()) command.directory = command.input.directory_with("-stability");
  return with_places(loaded, [&] {
    check_methods(loaded.value, command.methods);
    Session session(loaded.value, command);
    const auto names = session.names();
    for (const std::string& part : command.parts) {
      if (std::find(names.begin(), names.end(), part) != names.end()) continue;
      throw CaseFileError(
          fmt::format("--parts {}: unknown part; allowed: {}", part, fmt::join(names, ", ")));
    }
    check_beam(loaded.value, command.parts);
    return session.run();
  });
}

}  // namespace

void add_stability(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand(
      "stability", "Find where each method fails, and how; as tables, CSV and figures");
  auto options = std::make_shared<StabilityCommand>();
  options->input.add_case_to(*command);
  command
      ->add_option("--methods", options->methods,
                   "Only these methods, separated by commas; one without a table stands for all "
                   "its tables. Default: all")
      ->delimiter(',');
  command
      ->add_option(
          "--parts", options->parts,
          "Only these parts, separated by commas: critical (largest stable steps), contact "
          "(the same in stiff contact), damping (of implicit methods), map (right, wrong "
          "count, inaccurate, unstable, refused, failed), pairs (sub-impacts within one step), "
          "layers "
          "(against the exact section)")
      ->delimiter(',');
  add_directory_option(*command, options->directory,
                       "Directory for CSV and figures; made if missing. Default: the case file's "
                       "name without its ending, and -stability, in the current directory");
  command
      ->add_option("--run-seconds", options->run_seconds,
                   "Runs of the map that take longer are left out")
      ->check(positive_seconds)
      ->capture_default_str();
  command->footer(
      "All cores are used, since nothing is timed. Parts are printed and written one by one; after "
      "Ctrl-C the finished parts remain.\n"
      "Examples:\n"
      "  subimpact stability case.toml --out out/stability\n"
      "  subimpact stability case.toml --parts critical --methods central-difference,erk\n"
      "  subimpact stability case.toml --parts map --set time.end=2e-3\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a part failed or its figure could "
      "not be drawn, "
      "the other parts are complete; 130 "
      "stopped by Ctrl-C.");
  command->callback([options, &status] { status = run_stability(*options); });
}

}  // namespace subimpact::app
