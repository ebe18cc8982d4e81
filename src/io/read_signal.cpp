#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "case/keys/units.h"
#include "case/refuse.h"
#include "io/records/csv_reader.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

constexpr const char* remedy =
    "give a CSV file whose heading ends the names of two columns in the units of time and force, "
    "such as \"time_us,force_kN\" or \"t [ms];F [N]\", and whose numbers have decimal points";

// By how much a column's values are multiplied for SI, if its name ends in a unit of that kind:
// "force_kN", "F [kN]", "kN"; not "v_m_per_s".
std::optional<double> factor_of(std::string_view name, std::string_view unit) {
  const auto is_end = [](char c) { return c == ' ' || c == ')' || c == ']' || c == '"'; };
  while (!name.empty() && is_end(name.back())) name.remove_suffix(1);
  const std::size_t before = name.find_last_of("_ ([\"");
  std::string own(before == name.npos ? name : name.substr(before + 1));
  for (const std::string_view micro : {"µ", "μ"}) {  // U+00B5, U+03BC
    if (!own.starts_with(micro)) continue;
    own.erase(0, micro.size() - 1);
    own[0] = 'u';
  }
  if (before != name.npos && name.substr(0, before).ends_with("per")) return std::nullopt;
  return value_in(unit, "1" + own);
}

struct UnitColumn {
  std::size_t index;
  double factor;
};

UnitColumn column_in(const CsvReader& csv, const std::string& file, std::string_view unit,
                     std::string_view what) {
  std::vector<UnitColumn> found;
  std::string names;
  for (std::size_t i = 0; i < csv.heading().size(); ++i) {
    const std::string& name = csv.heading()[i];
    const std::optional<double> factor = factor_of(name, unit);
    if (!factor) continue;
    if (name.starts_with(what)) return {i, *factor};
    found.push_back({i, *factor});
    names += (names.empty() ? "" : ", ") + name;
  }
  if (found.size() == 1) return found.front();
  fail<ResultsError>(
      "{}:1: {} in a unit of {} ({}); {}", file,
      found.empty() ? "no column's name ends" : "the names of several columns (" + names + ") end",
      what, units_beside(unit),
      found.empty() ? remedy : fmt::format("let that of one of them begin with \"{}\"", what));
}

// With commas between cells, without carriage returns and byte order mark.
std::string normalised(std::string text, const std::string& file) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::erase(text, '\r');
  const std::string_view heading = std::string_view(text).substr(0, text.find('\n'));
  for (const char separator : {';', '\t'}) {
    if (heading.find(separator) == heading.npos) continue;
    if (const std::size_t comma = text.find(',', heading.size()); comma != text.npos) {
      fail<ResultsError>(
          "{}:{}: has a comma within a number; {}", file,
          1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(comma), '\n'),
          remedy);
    }
    std::ranges::replace(text, ',', ' ');  // of the heading
    std::ranges::replace(text, separator, ',');
    break;
  }
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

double number_in(const CsvReader& csv, std::size_t column) {
  const auto [number, rest] = split_unit(csv.cell(column));
  const double value =
      number.empty() || !rest.empty() ? NAN : std::strtod(std::string(number).c_str(), nullptr);
  if (!std::isfinite(value)) csv.refuse_cell(column, "a finite number with a decimal point");
  return value;
}

}  // namespace

Signal read_signal(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::ifstream stream(path);
  if (!stream)
    fail<ResultsError>("{}: cannot be read ({}); {}", file, std::strerror(errno), remedy);
  std::istringstream text(normalised({std::istreambuf_iterator<char>(stream), {}}, file));
  CsvReader csv(text, file, remedy);
  const UnitColumn time = column_in(csv, file, "s", "time");
  const UnitColumn force = column_in(csv, file, "N", "force");
  Signal signal;
  while (csv.next()) {
    signal.times.push_back(time.factor * number_in(csv, time.index));
    signal.forces.push_back(force.factor * number_in(csv, force.index));
    const std::size_t n = signal.times.size();
    if (n > 1 && !(signal.times[n - 1] > signal.times[n - 2])) {
      csv.refuse_cell(time.index, "a time later than that of the row above");
    }
  }
  if (signal.times.size() < 3) {
    fail<ResultsError>("{}: has {} rows of numbers, and 3 are the least; {}", file,
                       signal.times.size(), remedy);
  }
  return signal;
}

}  // namespace subimpact
