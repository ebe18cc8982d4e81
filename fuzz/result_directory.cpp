#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "byte_source.h"
#include "subimpact/io/read_results.h"
#include "subimpact/report/pages.h"
#include "targets.h"

namespace subimpact::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr const char* names[] = {"summary.json", "events.csv", "transitions.csv", "history.csv",
                                 "sections.csv"};
constexpr const char* values[] = {"nan",  "inf",        "-inf",        "0",
                                  "-0",   "-1",         "1",           "2",
                                  "",     "1e308",      "-1e308",      "1e-320",
                                  "1e-5", "2147483647", "-2147483648", "18446744073709551615",
                                  "null", "true",       "\"x\"",       "[]",
                                  "{}",   "[1, 2]",     "1e300",       "\"\\u001b[2J\""};

using Files = std::map<std::string, std::string>;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const Files& files_of_run() {
  static const Files files = [] {
    Files read;
    for (const char* name : names) read[name] = content(fs::path(SUBIMPACT_FUZZ_RUN) / name);
    return read;
  }();
  return files;
}

// The cell, or the value of a member, that holds the position.
std::pair<std::size_t, std::size_t> value_at(const std::string& text, std::size_t at) {
  constexpr std::string_view marks = ",:\n[]{} ";
  const std::size_t before = text.find_last_of(marks, at);
  const std::size_t start = before == text.npos ? 0 : before + 1;
  return {start, std::min(text.find_first_of(marks, start), text.size())};
}

void change(std::string& text, ByteSource& source) {
  if (text.empty()) return;
  const std::size_t at = source.below(text.size());
  const std::size_t line = text.find_last_of('\n', at) + 1;  // npos + 1: 0
  const std::size_t line_end = std::min(text.find('\n', at), text.size());
  switch (source.byte() % 8) {
    case 0:
      text.erase(line, line_end - line + 1);
      break;
    case 1:
      text.insert(line, text.substr(line, line_end - line) + '\n');
      break;
    case 2:
      text.resize(at);
      break;
    case 3:
      text[at] = static_cast<char>(source.byte());
      break;
    case 4:
      text.insert(at, 1, static_cast<char>(source.byte()));
      break;
    default: {
      const auto [start, end] = value_at(text, at);
      text.replace(start, end - start, source.one_of(values));
    }
  }
}

/// A directory of this process.
struct Directory {
  Directory() {
    std::string name = (fs::temp_directory_path() / "subimpact-fuzz-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Directory() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

}  // namespace

void result_directory(Bytes bytes) {
  static const Directory directory;
  Files files = files_of_run();
  ByteSource source(bytes);
  while (!source.at_end()) change(files[source.one_of(names)], source);
  for (const auto& [name, text] : files) {
    std::ofstream(directory.path / name, std::ios::binary) << text;
  }
  try {
    const FinishedRun run = read_results(directory.path);
    html_report(run);
  } catch (const ResultsError&) {
  }
}

}  // namespace subimpact::fuzz
