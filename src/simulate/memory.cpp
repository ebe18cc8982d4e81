#include "simulate/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace subimpact {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number in a file that holds nothing else; nothing for "max" or where there is no such file.
std::optional<double> number_in(const std::string& file) {
  std::ifstream stream(file);
  double number = 0.0;
  if (stream >> number) return number;
  return {};
}

double free_on_the_machine() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    double kilobytes = 0.0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024.0 * kilobytes;
  }
  return unlimited;
}

// Of version 2 of control groups: "0::/path".
double free_in_control_group() {
  std::ifstream file("/proc/self/cgroup");
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("0::/")) return unlimited;
  const std::string group = "/sys/fs/cgroup" + line.substr(3);
  const auto most = number_in(group + "/memory.max");
  const auto now = number_in(group + "/memory.current");
  return most && now ? *most - *now : unlimited;
}

double limit_of_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

double available_memory() {
  return std::min({free_on_the_machine(), free_in_control_group(), limit_of_process()});
}

}  // namespace subimpact
