#pragma once

#include <sstream>
#include <string>

namespace subimpact {

/// A summary with each of its lines in one piece: those that begin with twenty blanks go on.
inline std::string unwrapped(const std::string& summary) {
  std::istringstream lines(summary);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(' ');
    const bool goes_on = begin != std::string::npos && begin >= 20 && !text.empty();
    if (goes_on) text.back() = ' ';
    text += (goes_on ? line.substr(begin) : line) + '\n';
  }
  return text;
}

}  // namespace subimpact
