#pragma once

#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/answers.h"

namespace subimpact {

/// Rounding of a number to what its error allows (docs/files.md, "Digits for people"): 201.4763
/// with an error of 0.0163 is 201.476 +- 0.017, with 0.0261 it is 201.48 +- 0.03.
struct Rounding {
  int decimals = 0;        ///< of the number; -1: tens, -2: hundreds, ...
  double rounded = 0.0;    ///< the error
  std::string error = {};  ///< "0.017", "0.03"; "0" for an exact number
};

/// The rounding that an error allows, with at most `most_decimals`: a smaller error is stated as
/// one unit of the last of them. None for an error that is not finite, negative, or 1e15 and above.
std::optional<Rounding> rounding_of(double error, int most_decimals);

/// A number with so many decimals; negative: rounded to tens, hundreds, ...
std::string with_decimals(double value, int decimals);

/// A number without a known error, with so many significant digits: 8800 for 8796.3, 1.2e-09.
std::string with_digits(double value, int digits);

/// A quantity as people read it: the SI unit, the power of ten of the unit usual for it, and how
/// many digits are given at most, whatever the error.
struct Measure {
  const char* si;  ///< "N s"; empty: a ratio
  int usual = 0;   ///< -6: microseconds
  int most_digits = 6;
  double smallest = 1e-3, largest = 1e7;  ///< of the usual unit; beyond them another prefix
};
inline constexpr Measure as_ratio{""}, as_force{"N"}, as_impulse{"N s"}, as_energy{"J"},
    as_velocity{"m/s"}, as_rotation{"rad"}, as_time{"s", -6, 9, 1e-3, 1e4},
    as_instant{"s", -6, 9, 1.0, 1e4}, as_length{"m", -3, 6, 1e-3, 1e4}, as_gap{"m", -6},
    as_stress{"Pa", 6, 3};
/// Forces from a kilonewton on in kilonewtons.
inline constexpr Measure as_answered_force{"N", 3, 6, 1.0};

/// A unit in which a value is read: "us", "kN", "1e-27 N s"; `per_si`: of them in one SI unit.
struct ReadUnit {
  std::string name;
  double per_si = 1.0;
  bool is_power = false;  ///< "1e-27 N s"
};

/// The unit in which a size (SI) is read: the usual one from Measure::smallest to Measure::largest;
/// else one with another prefix or with a power of ten, of which the size is 1 to 1000.
ReadUnit unit_for(double size, const Measure& measure);

/// A number and the unit that it is in: "8.8 kN", "(2.040 +- 0.003)e-27 N s".
std::string with_unit(const std::string& number, const ReadUnit& unit);

/// An instant or a length of time, with so many digits: "333.333 us", "1.2 ns".
std::string time_text(double seconds, int digits = 6);

/// An error of times in words: "0.3 us", "0.012 us", "2 ms"; rounded as above.
std::string error_text(double seconds);

/// The sub-impacts of a run as people read them: in units that suit their size, with the digits
/// that their errors allow; without an error estimate, with a fixed number of digits. Sub-impacts
/// that are not certain have a question mark and three digits of the run that is shown, times as
/// many as its duration needs. Errors above a twentieth of a value are stated (a quarter, where not
/// certain), and a value below its error is a question mark.
struct SubImpactRows {
  struct Column {
    const char* name;
    std::string unit;
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

/// A number and its error, each by itself in a given unit: "8796.3" and "0.8"; three digits and no
/// error where that is not known; "at most 30000" where it exceeds the number.
struct NumberAndError {
  std::string number, error;
  bool is_lost = false;  ///< the error exceeds the number
};
NumberAndError number_and_error(const ReadUnit& unit, const Total& total, int most_digits);
/// The unit in which both are read.
ReadUnit unit_for(const Total& total, const Measure& measure);
/// A number with its error, in a given unit: "8796.3 +- 0.8"; three digits where no error is known,
/// and no number where the error exceeds it: "? (at most 30000)".
std::string number_in(const ReadUnit& unit, const Total& total, int most_digits);
/// The same with the unit that suits it: "8796.3 +- 0.8 N".
std::string text_of(const Total& total, const Measure& measure);
/// The same in three digits, the error left out where it is below a twentieth of the number.
std::string rough_text(const Total& total, const Measure& measure);
/// A number whose error is not known with all digits of the measure.
std::string plain_text(double value, const Measure& measure);
/// Decimals of a time whose error is not known: five digits of the end of the run.
int decimals_of_times(const Result& result, const ReadUnit& unit);
/// A number of sub-impacts or of zones: "48 +- 2", "12"; "3 here, at most 54" where the error
/// exceeds it.
std::string count_text(const Total& count);

/// A total of the run with its error: "8796.3 +- 0.8 N"; without an error estimate all digits of
/// the measure.
std::string total_text(const Result& result, RunTotal name, double value, const Measure& measure);

/// What struck what: "0.201 kg at 15.9 m/s (cylindrical nose of 10 mm) on the middle of ...".
std::string strike_words(const Case& input, const Result& result);

/// Where something is not certain: "sub-impact 3", or the flight before it: "after sub-impact 2",
/// "after the last sub-impact". `found`: with a first doubt.
std::string place_of_doubt(const Result& result, const ErrorEstimate& found);

}  // namespace subimpact
