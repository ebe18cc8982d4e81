#include "commands.h"
#include "report/files.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"

namespace subimpact::app {
namespace {

int explain(CaseOptions& options) {
  const LoadedCase loaded = options.load();
  with_places(loaded, [&] {
    const std::string text = explanation(loaded.value, loaded.given);
    print_doubts(loaded);
    print("{}", text);
  });
  return done;
}

const std::vector<std::string> scenes = {"hammer",           "ball-drop", "cantilever", "stop",
                                         "repeated-strikes", "tube",      "rollers",    "ensemble"};

struct NewOptions {
  std::string scene;  // none: all are listed
};

std::string_view case_of(const std::string& scene) {
  return embedded_file("../../examples/cases/" + scene + ".toml");
}

int print_new_case(NewOptions& options) {
  if (!options.scene.empty()) {
    print("{}", case_of(options.scene));
    return done;
  }
  for (const std::string& scene : scenes) {  // with the first line of its case, after "# "
    print("{:<18} {}\n", scene, case_of(scene).substr(2, case_of(scene).find('\n') - 2));
  }
  print("\nOne of them to begin with: subimpact new hammer > case.toml\n");
  return done;
}

struct ListingOptions {
  bool as_schema = false;  // of `keys`
  std::string word;        // of `keys`: in those wanted
};

int print_keys(ListingOptions& options) {
  const std::string listing = options.as_schema ? case_schema() : key_listing(options.word);
  if (listing.empty()) {
    throw UsageError("WORD", "no key has \"" + options.word + "\" in it; all: subimpact keys");
  }
  print("{}", listing);
  return done;
}

std::vector<Option> explain_options(CaseOptions& options) {
  options.may_repeat = true;
  return options.of_case_and_method() + std::vector<Option>{options.of_within()};
}

std::vector<Option> new_options(NewOptions& options) {
  return {{"SCENE",
           &options.scene,
           "One of these; without it, all are listed, a line each",
           {},
           scenes}};
}

std::vector<Option> key_options(ListingOptions& options) {
  Option schema = {"--schema", &options.as_schema,
                   "Print a JSON schema (draft 2020-12) of the case file instead, for editors"};
  schema.excludes = {"WORD"};
  return {
      {"WORD", &options.word, "List only keys with this word in their name, meaning or choices"},
      schema};
}

Command listing_command(const char* name, const char* description, std::string footer,
                        std::string (*listing)()) {
  return {name, description, {}, std::move(footer), [=](const auto&) -> int {
            print("{}", listing());
            return done;
          }};
}

}  // namespace

Command explain_command() {
  return command_with(
      "explain", "Show what a run of a case will take and how it will be modelled", explain,
      explain_options,
      "Examples:\n"
      "  subimpact explain case.toml\n"
      "  subimpact explain case.toml --within 1us\n"
      "  subimpact explain case.toml --method central-difference --set model.segments=1001\n"
      "Exit status: 0 done; 2 bad command line or case file.");
}

Command new_command() {
  return command_with("new", "Print a commented case file to begin with", print_new_case,
                      new_options,
                      "Examples:\n"
                      "  subimpact new\n"
                      "  subimpact new cantilever > case.toml && subimpact run case.toml");
}

std::vector<Command> listing_commands() {
  return {
      listing_command("methods", "List the time integration methods and Butcher tables",
                      "Example:\n  subimpact methods", method_listing),
      command_with(
          "keys", "List the keys of a case file: units, allowed values, defaults", print_keys,
          key_options,
          "Examples:\n  subimpact keys\n  subimpact keys yield\n  subimpact keys --schema > "
          "subimpact.schema.json\n\n"
          "A case file that begins with `#:schema ./subimpact.schema.json` is then completed and\n"
          "checked by editors that use Taplo (in VS Code: the extension Even Better TOML)."),
      listing_command("columns",
                      "List the columns of the CSV tables that a run writes: units, meanings",
                      "Example:\n  subimpact columns", column_listing),
      listing_command(
          "completion", "Print the completion of commands and options for bash",
          "Example, in ~/.bashrc, where no package has put it in place:\n  source <(subimpact "
          "completion)",
          [] { return std::string(embedded_file("../../apps/subimpact/completion.bash")); })};
}

}  // namespace subimpact::app
