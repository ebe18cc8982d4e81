#include "io/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/counted.h"
#include "subimpact/io/read_results.h"

namespace subimpact {

namespace {
constexpr std::size_t longest_quotation = 80;
}

CsvReader::CsvReader(std::istream& file, std::string name, std::string remedy)
    : file_(file), name_(std::move(name)), remedy_(std::move(remedy)) {
  if (!read_line()) {
    throw ResultsError(fmt::format("{}: has no heading; {}", name_, remedy_));
  }
  heading_.assign(cells_.begin(), cells_.end());
}

bool CsvReader::read_line() {
  if (!std::getline(file_, line_)) return false;
  ++n_lines_;
  cells_.clear();
  const std::string_view line = line_;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    cells_.push_back(line.substr(start, end - start));
    start = end + 1;
  }
  return true;
}

bool CsvReader::next() {
  if (!read_line()) return false;
  if (cells_.size() != heading_.size()) {
    throw ResultsError(fmt::format("{}:{}: has {} where the header has {}; {}", name_, n_lines_,
                                   counted(cells_.size(), "cell"), heading_.size(), remedy_));
  }
  return true;
}

std::size_t CsvReader::find(std::string_view column) const {
  return static_cast<std::size_t>(std::find(heading_.begin(), heading_.end(), column) -
                                  heading_.begin());
}

void CsvReader::refuse_lack_of(std::string_view column) const {
  throw ResultsError(fmt::format("{}: has no column {}; its columns are {}; {}", name_, column,
                                 fmt::join(heading_, ", "), remedy_));
}

void CsvReader::refuse_cell(std::size_t column, const char* allowed) const {
  throw ResultsError(fmt::format("{}:{}: {} is \"{}\"; allowed: {}; {}", name_, n_lines_,
                                 heading_[column], cells_[column].substr(0, longest_quotation),
                                 allowed, remedy_));
}

}  // namespace subimpact
