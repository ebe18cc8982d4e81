#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// Rounding of a number to what its error allows. The error has one significant digit, two where
/// that digit is a 1, and is rounded up; the number is rounded to the place of the error's last
/// digit: 201.4763 with an error of 0.0163 is 201.476 +- 0.017, with 0.0261 it is 201.48 +- 0.03.
struct Rounding {
  int decimals = 0;   ///< of the number; -1: tens, -2: hundreds, ...
  std::string error;  ///< "0.017", "0.03"; "0" for an exact number
};

/// The rounding that an error allows, with at most `most_decimals`: a smaller error is stated as
/// one unit of the last of them. None for an error that is not finite, negative, or 1e15 and above.
std::optional<Rounding> rounding_of(double error, int most_decimals);

/// A number with so many decimals; negative: rounded to tens, hundreds, ...
std::string with_decimals(double value, int decimals);

/// A number without a known error, with so many significant digits: 8800 for 8796.3, 1.2e-09.
std::string with_digits(double value, int digits);

/// An error of times in words: "0.3 us", "0.012 us", "2 ms"; rounded as above.
std::string error_text(double seconds);

/// The sub-impacts of a run as people read them: microseconds, newtons, millimetres, with the
/// digits that their errors allow; without an error estimate, with a fixed number of digits. A time
/// is followed by its error, and a duration is rounded to the sum of the errors of start and end.
/// Sub-impacts that are not certain have a question mark and three digits of the run that is shown,
/// times as many as its duration needs.
struct SubImpactRows {
  struct Column {
    const char* name;
    const char* unit;
    std::size_t width = 0;  ///< in characters, at least that of its cells
  };
  std::vector<Column> columns;
  struct Row {
    bool is_certain = true;          ///< also where no error estimate exists
    std::vector<std::string> cells;  ///< one per column, decimal points under each other
  };
  std::vector<Row> rows;
};

/// `plus_minus`: what stands between a time and its error.
SubImpactRows sub_impact_rows(const Result& result, const char* plus_minus = "+-");

/// A number with its error, "8796.3 +- 0.8", with at most so many decimals; three digits where no
/// error is known. `factor`: from SI to the unit of the text.
std::string text_of(const Total& total, double factor, int decimals);

/// The error of a total, by its name in summary.json; none where it is not known.
std::optional<double> error_of_total(const Result& result, std::string_view name);

/// A total of the run with its error: "8796.3 +- 0.8 N"; without an error estimate so many
/// decimals. `name`: as in summary.json; `factor`: from SI to `unit`.
std::string total_text(const Result& result, const char* name, double value, double factor,
                       int decimals, const char* unit);

/// Where something is not certain: "sub-impact 3", or the flight before it: "after sub-impact 2",
/// "after the last sub-impact". `first_unresolved`, `reason`: of the error estimate or of a part.
std::string place_of_doubt(const Result& result, std::size_t first_unresolved,
                           const std::string& reason);

}  // namespace subimpact
