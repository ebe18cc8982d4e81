#include "io/sub_impact_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "io/uncertain.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr double mm = 1e3;  // per metre
constexpr double unknown = std::numeric_limits<double>::infinity();

constexpr std::size_t least_number_width = 4;

enum Quantity { start, end, duration, peak, impulse, indentation, residual, velocity };
constexpr std::size_t n_quantities = 8;

struct QuantityFormat {
  const char* name;
  const char* unit;
  std::size_t least_width;
  int decimals;       // without an error estimate
  int most_decimals;  // with one
  bool is_time;
  bool shows_error;
};
constexpr QuantityFormat formats[n_quantities] = {
    {"start", "us", 13, 4, 6, true, true},      {"end", "us", 13, 4, 6, true, true},
    {"duration", "us", 11, 4, 6, true, false},  {"peak force", "N", 11, 2, 2, false, false},
    {"impulse", "N s", 11, 6, 6, false, false}, {"indentation", "max, mm", 12, 7, 7, false, false},
    {"residual", "mm", 12, 7, 7, false, false}, {"striker", "m/s", 11, 6, 6, false, false},
};

struct Cell {
  std::string value, error;
};

struct Number {
  std::optional<double> value;  // in the unit of its column; none: the sub-impact has no end
  double error = unknown;
};
using Numbers = std::vector<Number>;  // one per quantity

std::optional<double> scaled(const std::optional<double>& value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

// Sums of errors over the sub-impacts so far, and the values before the next one.
struct Sums {
  double velocity = 0.0, velocity_error = 0.0;
  double residual = 0.0, residual_error = 0.0;
};

Numbers numbers_of(const SubImpact& s, double end_or_last, Sums& sums) {
  const double start_error = s.start_error.value_or(unknown);
  // A contact that is still open has no end whose error could stand for those of its values.
  const double end_error = s.end ? s.end_error.value_or(unknown) : unknown;
  const double length = end_or_last - s.start;
  const double relative = length > 0.0 ? (start_error + end_error) / length : unknown;
  const auto error_of = [&](double value, double before = 0.0) {
    return value == before ? 0.0 : relative * std::abs(value - before);
  };
  const double indentation_error = sums.residual_error + error_of(s.max_indentation, sums.residual);
  sums.velocity_error += error_of(s.striker_velocity, sums.velocity);
  sums.residual_error += error_of(s.residual_indentation, sums.residual);
  sums.velocity = s.striker_velocity;
  sums.residual = s.residual_indentation;
  Numbers numbers(n_quantities);
  numbers[start] = {s.start * us, start_error * us};
  numbers[end] = {scaled(s.end, us), end_error * us};
  numbers[duration] = {s.end ? std::optional(length * us) : std::nullopt,
                       (start_error + end_error) * us};
  numbers[peak] = {s.peak_force, error_of(s.peak_force)};
  numbers[impulse] = {s.impulse, error_of(s.impulse)};
  numbers[indentation] = {s.max_indentation * mm, indentation_error * mm};
  numbers[residual] = {s.residual_indentation * mm, sums.residual_error * mm};
  numbers[velocity] = {s.striker_velocity, sums.velocity_error};
  return numbers;
}

// An exact number shows the digits that it has: "0" for the first start.
std::string exact_text(double value, int decimals) {
  std::string text = with_decimals(value, decimals);
  if (text.find('.') == text.npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// Formats the numbers of one quantity, row after row.
class Formatter {
 public:
  /// `undecided_decimals`: most decimals of rows that are not decided, where an error is known.
  Formatter(const QuantityFormat& format, bool has_errors, std::optional<int> undecided_decimals)
      : format_(format), has_errors_(has_errors), decimals_(undecided_decimals) {}

  Cell cell(const Number& number, bool is_decided) {
    if (!number.value) return {};
    if (!has_errors_) return {with_decimals(*number.value, format_.decimals), {}};
    const std::optional<Rounding> rounding = rounding_of(number.error, format_.most_decimals);
    const char* doubt = format_.shows_error ? "?" : "";
    if (is_decided && !rounding) return {with_two_digits(*number.value), doubt};
    if (!is_decided) {
      if (rounding && number.error > 0.0) allow_decimals(rounding->decimals);
      return {decimals_ ? with_decimals(*number.value, *decimals_) : with_two_digits(*number.value),
              doubt};
    }
    if (number.error == 0.0) return {exact_text(*number.value, rounding->decimals), {}};
    allow_decimals(rounding->decimals);
    return {with_decimals(*number.value, rounding->decimals),
            format_.shows_error ? rounding->error : std::string()};
  }

 private:
  void allow_decimals(int decimals) {
    decimals_ = std::min(decimals_.value_or(format_.decimals), decimals);
  }

  const QuantityFormat& format_;
  bool has_errors_;
  std::optional<int> decimals_;  // of rows that are not decided; none while no error is known
};

// The decimals that the largest error of a time leaves; none if no error is known.
std::optional<int> decimals_of_times(const std::vector<Numbers>& rows) {
  double largest = 0.0;
  for (const Numbers& row : rows) {
    for (const Quantity q : {start, end}) {
      if (std::isfinite(row[q].error)) largest = std::max(largest, row[q].error);
    }
  }
  if (largest == 0.0) return std::nullopt;
  const std::optional<Rounding> rounding = rounding_of(largest, formats[start].decimals);
  return rounding ? std::optional(rounding->decimals) : std::nullopt;
}

// Puts the decimal points of a column under each other, and words to the right; each text then has
// the same width.
void align(std::vector<std::string>& texts) {
  const auto is_word = [](const std::string& text) { return text.starts_with('('); };
  std::size_t before = 0, after = 0;  // the point, which counts as after
  for (const std::string& text : texts) {
    if (is_word(text)) continue;
    const std::size_t point = std::min(text.find('.'), text.size());
    before = std::max(before, point);
    after = std::max(after, text.size() - point);
  }
  for (const std::string& text : texts) {
    if (is_word(text)) before = std::max(before + after, text.size()) - after;
  }
  for (std::string& text : texts) {
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::size_t trailing = is_word(text) ? 0 : after - (text.size() - point);
    text = fmt::format("{:>{}}", text + std::string(trailing, ' '), before + after);
  }
}

// The cells of a column, of equal width, and that width.
std::pair<std::vector<std::string>, std::size_t> column_texts(const std::vector<Cell>& cells,
                                                              const char* plus_minus) {
  std::vector<std::string> values, errors;
  for (const Cell& cell : cells) {
    values.push_back(cell.value);
    errors.push_back(cell.error);
  }
  align(values);
  align(errors);
  std::size_t width = cells.empty() ? 0 : values.front().size();
  const std::size_t error_width = cells.empty() ? 0 : errors.front().size();
  if (error_width == 0) return {values, width};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool has_error = !cells[i].error.empty();
    values[i] += fmt::format(" {} {}", has_error ? plus_minus : "  ", errors[i]);
  }
  return {values, width + error_width + 4};
}

}  // namespace

SubImpactRows sub_impact_rows(const Result& result, const char* plus_minus) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  const std::size_t n_decided = result.n_decided().value_or(all.size());
  SubImpactRows table;
  table.columns.push_back({"", "no.", least_number_width});
  std::vector<std::string> numbers;
  std::vector<Numbers> rows;
  Sums sums;
  for (std::size_t i = 0; i < all.size(); ++i) {
    table.rows.push_back({i < n_decided, {}});
    const char* mark = i < n_decided ? (n_decided < all.size() ? " " : "") : "?";
    numbers.push_back(fmt::format("{}{}", i + 1, mark));
    rows.push_back(numbers_of(all[i], result.end_of(all[i]), sums));
  }
  const auto add_column = [&](std::vector<std::string> texts, std::size_t width) {
    SubImpactRows::Column& column = table.columns.back();
    column.width = std::max(column.width, width);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      table.rows[i].cells.push_back(std::move(texts[i]));
    }
  };
  const std::size_t number_width = numbers.empty() ? 0 : numbers.back().size();
  for (std::string& number : numbers) number = fmt::format("{:>{}}", number, number_width);
  add_column(numbers, number_width);
  const std::optional<int> time_decimals = decimals_of_times(rows);
  for (std::size_t q = 0; q < n_quantities; ++q) {
    Formatter formatter(formats[q], result.error_estimate.has_value(),
                        formats[q].is_time ? time_decimals : std::nullopt);
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < all.size(); ++i) {
      cells.push_back(formatter.cell(rows[i][q], i < n_decided));
      if (q == end && !all[i].end) cells.back() = {"(open)", {}};
    }
    auto [texts, width] = column_texts(cells, plus_minus);
    table.columns.push_back({formats[q].name, formats[q].unit, formats[q].least_width});
    add_column(std::move(texts), width);
  }
  return table;
}

FinalErrors final_errors(const Case& input, const Result& result) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  const std::size_t n_decided = result.n_decided().value_or(0);
  FinalErrors errors;
  double force = 0.0, indentation = 0.0;
  Sums sums;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Numbers row = numbers_of(all[i], result.end_of(all[i]), sums);
    const auto error = [&](Quantity q) { return i < n_decided ? row[q].error : unknown; };
    if (all[i].peak_force > force) {
      force = all[i].peak_force;
      errors.max_force = error(peak);
    }
    if (all[i].max_indentation > indentation) {
      indentation = all[i].max_indentation;
      errors.max_indentation = error(Quantity::indentation) / mm;
    }
    errors.striker_velocity = error(velocity);
  }
  if (!result.error_estimate || result.error_estimate->first_unresolved) {
    errors.striker_velocity = unknown;
  }
  const bool is_conserved = result.max_momentum_error && input.scene.beam.damping.mass == 0.0;
  errors.beam_velocity =
      is_conserved ? errors.striker_velocity * input.scene.striker.mass / input.scene.beam.mass()
                   : unknown;
  return errors;
}

std::string undecided_reason(const Result& result) {
  if (!result.error_estimate || !result.error_estimate->first_unresolved) return {};
  const std::string& reason = result.error_estimate->reason;
  return reason.empty() ? "the reason is not known" : reason;
}

}  // namespace subimpact
