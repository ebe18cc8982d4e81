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
                                         "repeated-strikes", "tube",      "ensemble"};

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

template <std::string (*listing)()>
int print_listing(ListingOptions&) {
  print("{}", listing());
  return done;
}

int print_keys(ListingOptions& options) {
  const std::string listing = options.as_schema ? case_schema() : key_listing(options.word);
  if (listing.empty()) {
    throw CLI::ValidationError("WORD",
                               "no key has \"" + options.word + "\" in it; all: subimpact keys");
  }
  print("{}", listing);
  return done;
}

}  // namespace

void add_explain(CLI::App& program, int& status) {
  auto [command, options] =
      add_command(program, status, "explain",
                  "Show what a run of a case will take and how it will be modelled", explain);
  options.add_to(command);
  options.add_within_to(command);
  options.may_repeat = true;
  command.footer(
      "Examples:\n"
      "  subimpact explain case.toml\n"
      "  subimpact explain case.toml --within 1us\n"
      "  subimpact explain case.toml --method central-difference --set model.segments=1001\n"
      "Exit status: 0 done; 2 bad command line or case file.");
}

void add_new(CLI::App& program, int& status) {
  auto [command, options] = add_command(
      program, status, "new", "Print a commented case file to begin with", print_new_case);
  command
      .add_option("SCENE", options.scene, "One of these; without it, all are listed, a line each")
      ->check(CLI::IsMember(scenes));
  command.footer(
      "Examples:\n"
      "  subimpact new\n"
      "  subimpact new cantilever > case.toml && subimpact run case.toml");
}

void add_listings(CLI::App& program, int& status) {
  add_command(program, status, "methods", "List the time integration methods and Butcher tables",
              print_listing<method_listing>)
      .first.footer("Example:\n  subimpact methods");
  auto [command, options] =
      add_command(program, status, "keys",
                  "List the keys of a case file: units, allowed values, defaults", print_keys);
  CLI::Option* word = command.add_option(
      "WORD", options.word, "List only keys with this word in their name, meaning or choices");
  command
      .add_flag("--schema", options.as_schema,
                "Print a JSON schema (draft 2020-12) of the case file instead, for editors")
      ->excludes(word);
  command.footer(
      "Examples:\n  subimpact keys\n  subimpact keys yield\n  subimpact keys --schema > "
      "subimpact.schema.json\n\n"
      "A case file that begins with `#:schema ./subimpact.schema.json` is then completed and\n"
      "checked by editors that use Taplo (in VS Code: the extension Even Better TOML).");
  add_command(program, status, "columns",
              "List the columns of the CSV tables that a run writes: units, meanings",
              print_listing<column_listing>)
      .first.footer("Example:\n  subimpact columns");
}

}  // namespace subimpact::app
