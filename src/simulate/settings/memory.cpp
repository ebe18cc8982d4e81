#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "simulate/run_parts.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number in a file that holds nothing else; nothing for "max" or where there is no such file.
std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0.0;
  if (stream >> number) return number;
  return {};
}

// The number that follows a word in a file; nothing where there is none.
std::optional<double> number_after(std::string_view wanted, const fs::path& file) {
  std::ifstream stream(file);
  for (std::string word; stream >> word;) {
    double number = 0.0;
    if (word == wanted && stream >> number) return number;
  }
  return {};
}

double free_on_the_machine(const fs::path& root) {
  const auto kilobytes = number_after("MemAvailable:", root / "proc/meminfo");
  return kilobytes ? 1024.0 * *kilobytes : unlimited;
}

double free_in_group(const fs::path& group) {
  const auto most = number_in(group / "memory.max");
  const auto now = number_in(group / "memory.current");
  const double pages_of_files = number_after("file", group / "memory.stat").value_or(0.0);
  return most && now ? *most - (*now - pages_of_files) : unlimited;
}

// For version 2 of control groups: "0::/path". The limits of parent groups hold too.
double free_in_control_groups(const fs::path& root) {
  std::ifstream file(root / "proc/self/cgroup");
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("0::/")) return unlimited;
  fs::path group = root / "sys/fs/cgroup";
  double least = free_in_group(group);
  for (const fs::path& name : fs::path(line.substr(4))) {
    group /= name;
    least = std::min(least, free_in_group(group));
  }
  return least;
}

double limit_of_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

double available_memory(const fs::path& root) {
  return std::min({free_on_the_machine(root), free_in_control_groups(root), limit_of_process()});
}

}  // namespace subimpact
