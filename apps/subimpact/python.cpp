#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "commands.h"

namespace subimpact::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* remedy =
    "this command needs Python 3.9 or later with the package subimpact and, but for the page of a "
    "run, NumPy, pandas, SciPy and Matplotlib (Debian: apt-get install python3-subimpact "
    "python3-pandas python3-scipy python3-matplotlib); SUBIMPACT_PYTHON_EXECUTABLE names another "
    "interpreter";

// Arguments: the remedy, the module and its own arguments. As `python -m`, but that modules in the
// working directory are not taken for others, and that a missing one, or a Python that is too old,
// is no traceback.
constexpr const char* start_module = R"(import runpy, sys
remedy = sys.argv[1]
sys.argv = sys.argv[2:]
sys.path = [place for place in sys.path if place]
def refuse(cause):
    sys.stderr.write("subimpact: %s: %s; %s\n" % (sys.executable, cause, remedy))
    sys.exit(2)
if sys.version_info < (3, 9):
    refuse("is Python %d.%d" % sys.version_info[:2])
try:
    runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
except ModuleNotFoundError as error:
    refuse(error)
)";

// The directory above that of the program.
fs::path own_prefix() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
}

// In a virtual environment, where pip installs the program, that of the environment.
std::string interpreter() {
  const char* named = std::getenv("SUBIMPACT_PYTHON_EXECUTABLE");
  if (named != nullptr && *named != '\0') return named;
  std::error_code error;
  return fs::exists(own_prefix() / "pyvenv.cfg", error)
             ? (own_prefix() / "bin" / "python3").string()
             : SUBIMPACT_PYTHON_EXECUTABLE;
}

// The first directory with the package: in the build tree, below the prefix; else empty.
std::string package_directory() {
  std::error_code error;
  for (const fs::path& place : {own_prefix() / "python", own_prefix() / SUBIMPACT_PYTHON_DIR}) {
    if (fs::exists(place / "subimpact" / "__init__.py", error)) return place.string();
  }
  return {};
}

// Runs Python with the package of this program before those of PYTHONPATH. Returns, with a message,
// only if it cannot be run.
int become_python(std::vector<std::string> words) {
  const std::string python = interpreter(), package = package_directory();
  const char* given = std::getenv("PYTHONPATH");
  const std::string others = given != nullptr ? given : "";
  const char* between = package.empty() || others.empty() ? "" : ":";
  setenv("PYTHONPATH", (package + between + others).c_str(), 1);
  words.insert(words.begin(), python);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execvp(python.c_str(), pointers.data());
  print_error("subimpact: {}: cannot be run; {}\n", python, remedy);
  return refused;
}

// Waits for the end of a process. A terminal sends Ctrl-C to both; the child decides how to end.
int status_of_ended(pid_t child) {
  const auto of_parent = std::signal(SIGINT, SIG_IGN);
  int state = 0;
  while (waitpid(child, &state, 0) < 0 && errno == EINTR) {
  }
  std::signal(SIGINT, of_parent);
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

}  // namespace

int run_python(const std::string& module, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"-c", start_module, remedy, module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::fflush(stdout);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child > 0) return status_of_ended(child);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  _exit(getppid() == parent ? become_python(words) : failed);
}

std::vector<Command> python_commands() {
  // Each takes its arguments, and prints its help, itself.
  const auto of_package = [](const char* name, const char* module, const char* description) {
    return Command{
        name,
        description,
        {},
        fmt::format("Needs the Python package; subimpact {} --help has its options.", name),
        [=](const auto& rest) { return run_python(module, rest); },
        true,
        true};
  };
  const Command python = {
      "python",
      "Run Python where `import subimpact` finds the package of this program",
      {},
      "Its arguments are those of Python. The package is that of the build tree or of the "
      "installation of this program, else the one "
      "that Python has. SUBIMPACT_PYTHON_EXECUTABLE names another interpreter.\n"
      "Examples:\n"
      "  subimpact python\n"
      "  subimpact python script.py\n"
      "  subimpact python -c 'import subimpact; print(subimpact.__version__)'\n"
      "Exit status: that of Python; 2 without Python.",
      [](const auto& rest) { return become_python(rest); },
      true};
  return {of_package("plot", "subimpact.plot",
                     "Draw the figures of a run, a sweep or a study (SVG, PNG and PDF)"),
          of_package("sensitivity", "subimpact.derivatives",
                     "Show how event times, forces and velocities depend on the numbers of a case"),
          of_package("scatter", "subimpact.predictability",
                     "Show how far a strike can be predicted whose numbers scatter"),
          python};
}

}  // namespace subimpact::app
