#pragma once

#include <string>
#include <vector>

namespace subimpact::app {

/// Runs a module of Python's package subimpact with these arguments, its streams being those of the
/// program, and returns its exit status: 128 and the number of a signal that ended it. The
/// interpreter is that of the environment variable SUBIMPACT_PYTHON_EXECUTABLE, else the one that
/// CMake found; the package is that of the build tree or the installation of the program, else what
/// the interpreter has. Where a module is missing, one line on stderr says what to install, and the
/// status is `refused`.
int run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace subimpact::app
