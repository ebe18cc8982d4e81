// The digits of numbers do not depend on the size of the bodies.

#include <regex>

#include "case_with.h"
#include "sample_result.h"
#include "testing.h"
#include "text/summary_lines.h"

namespace subimpact {
namespace {

Case paper_case() { return paper_case_with({}); }

// The sample, of bodies larger by that factor at the same velocities.
Result scaled_sample(double scale, std::size_t n_certain) {
  Result result = sample_result_with_errors(n_certain);
  const auto scaled = [&](auto& value, double by) {
    if constexpr (requires { value.has_value(); }) {
      if (value) *value *= by;
    } else {
      value *= by;
    }
  };
  const double square = scale * scale, cube = square * scale;
  for (SubImpact& s : result.sub_impacts) {
    s.peak_time = s.start + 1e-5;
    for (auto* time : {&s.start, &s.peak_time}) scaled(*time, scale);
    for (auto* time : {&s.end, &s.start_error, &s.end_error}) scaled(*time, scale);
    for (auto* length : {&s.max_indentation, &s.residual_indentation}) scaled(*length, scale);
    for (auto* error :
         {&s.max_indentation_error, &s.residual_indentation_error, &s.opening_error, &s.opening}) {
      scaled(*error, scale);
    }
    scaled(s.peak_force, square);
    scaled(s.peak_force_error, square);
    scaled(s.impulse, cube);
    scaled(s.impulse_error, cube);
  }
  scaled(result.outcome.time, scale);
  scaled(result.max_force, square);
  scaled(result.max_indentation, scale);
  result.used.initial_energy = 25.0 * cube;
  for (auto& [name, total] : result.error_estimate->totals) {
    const double by = name == RunTotal::impulse      ? cube
                      : name == RunTotal::peak_force ? square
                      : name == RunTotal::max_indentation || name == RunTotal::residual_indentation
                          ? scale
                          : 1.0;
    scaled(total.value, by);
    scaled(total.error, by);
  }
  result.error_estimate->totals.push_back({RunTotal::dissipated, {0.0, 0.02 * cube}});
  for (ZoneTotals& zone : result.error_estimate->zones) {
    for (Total* time : {&zone.start, &zone.end}) {
      scaled(time->value, scale);
      scaled(time->error, scale);
    }
    scaled(zone.impulse.value, cube);
    scaled(zone.impulse.error, cube);
  }
  scaled(result.error_estimate->largest_error, scale);
  result.final_energies = {3.3333 * cube, 5.5555 * cube, 4.4444 * cube, 9.6666 * cube,
                           0.0,           1.5002 * cube, 0.5 * cube};
  return result;
}

// The digits of each number, without zeros at its ends, and without powers of ten.
std::vector<std::string> digits_in(const std::string& text) {
  static const std::regex power("( 1)?e[-+]?[0-9]+"), number("[0-9]+[.]?[0-9]*");
  const std::string plain = std::regex_replace(text, power, "");
  std::vector<std::string> all;
  for (std::sregex_iterator it(plain.begin(), plain.end(), number), end; it != end; ++it) {
    std::string digits = it->str();
    std::erase(digits, '.');
    digits.erase(0, digits.find_first_not_of('0'));
    digits.erase(digits.find_last_not_of('0') + 1);
    all.push_back(digits);
  }
  return all;
}

TEST(RunSummary, AndTheTableHaveTheSameDigitsAtEveryScale) {
  for (const std::size_t n_certain : {1u, 3u}) {
    const auto texts = [&](double scale) {
      const Result result = scaled_sample(scale, n_certain);
      std::string text = sub_impact_table(result, false) + sub_impact_table(result);
      const std::string summary = summary_of(paper_case(), result);
      for (const char* label :
           {"largest force", "impulse", "  zone 1", "  zone 2", "dent", "energy", "restitution"}) {
        text += line_of(summary, label) + '\n';
      }
      return text;
    };
    const std::string here = texts(1.0);
    for (int exponent = -9; exponent <= 9; ++exponent) {
      const std::string there = texts(std::pow(10.0, exponent));
      EXPECT_EQ(digits_in(here), digits_in(there)) << here << there;
      expect_not_in(there, "0000000");
    }
  }
}

TEST(RunSummary, JoinsASharesOfTheEnergyThatIsBelowItsError) {
  Result result = scaled_sample(1.0, 3);
  result.error_estimate->totals.back().total.error = 0.7;
  expect_in(answer_to(paper_case(), result, AnswerKey::energy).note,
            "dent and damping of the beam");
}

}  // namespace
}  // namespace subimpact
