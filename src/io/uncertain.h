#pragma once

#include <optional>
#include <string>

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

}  // namespace subimpact
