#include "io/records/csv_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/counted.h"
#include "case/refuse.h"
#include "subimpact/io/read_results.h"

namespace subimpact {

namespace {
constexpr std::size_t longest_quotation = 80;
}

CsvReader::CsvReader(std::istream& file, std::string name, std::string remedy)
    : file_(file), name_(std::move(name)), remedy_(std::move(remedy)) {
  if (!read_line()) fail<ResultsError>("{}: has no heading; {}", name_, remedy_);
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
    fail<ResultsError>("{}:{}: has {} where the header has {}; {}", name_, n_lines_,
                       counted(cells_.size(), "cell"), heading_.size(), remedy_);
  }
  return true;
}

std::size_t CsvReader::find(std::string_view column) const {
  return static_cast<std::size_t>(std::find(heading_.begin(), heading_.end(), column) -
                                  heading_.begin());
}

void CsvReader::refuse_lack_of(std::string_view column) const {
  fail<ResultsError>("{}: has no column {}; its columns are {}; {}", name_, column,
                     fmt::join(heading_, ", "), remedy_);
}

void CsvReader::refuse_cell(std::size_t column, const char* allowed) const {
  fail<ResultsError>("{}:{}: {} is \"{}\"; allowed: {}; {}", name_, n_lines_, heading_[column],
                     cells_[column].substr(0, longest_quotation), allowed, remedy_);
}

void RowOrder::refuse(const char* column, double value, const char* allowed) const {
  fail<ResultsError>("{}:{}: {} is {:.17g}; allowed: {}; run the case again", file_, line_, column,
                     value, allowed);
}

void RowOrder::check_time(const char* column, double time) {
  if (time < 0.0) refuse(column, time, "a finite number, 0 or above");
  if (time < last_time_) refuse(column, time, "the time of the row above, or later");
  last_time_ = time;
}

// `last`: that of the row above.
void RowOrder::check_number(const char* column, int number, int& last) const {
  if (number < 1 || (number != last && number != last + 1)) {
    refuse(column, number, "the number of the row above or the next one, from 1");
  }
  last = number;
}

void RowOrder::check(const SubImpact& row) {
  ++line_;
  check_time("start_s", row.start);
  if (row.end && *row.end < row.start) {
    refuse("end_s", *row.end, "start_s or later, or an empty cell");
  }
  if (row.zone != last_zone_) last_subzone_ = 0;
  check_number("zone", row.zone, last_zone_);
  check_number("subzone", row.subzone, last_subzone_);
}

}  // namespace subimpact
