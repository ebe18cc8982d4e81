#include "report/text/uncertain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/units.h"

namespace subimpact {
namespace {

constexpr double largest_error = 1e15;
constexpr double rounding_slack = 1e-9;  // of a digit: 0.3 is three units of 0.1, not four

constexpr int smallest_prefix = -15, largest_prefix = 9;  // powers of ten
constexpr const char* prefixes[] = {"f", "p", "n", "u", "m", "", "k", "M", "G"};

// Units of 10^-decimals, rounded up.
double units_up(double error, int decimals) {
  const double power = std::pow(10.0, std::abs(decimals));
  return std::ceil((decimals >= 0 ? error * power : error / power) - rounding_slack);
}

constexpr double silent_error = 0.05;  // of a value, beyond which it is stated
constexpr double loud_error = 0.25;    // the same in rows that are marked as not certain

int exponent_of(double size) {
  return size > 0.0 && std::isfinite(size) ? static_cast<int>(std::floor(std::log10(size))) : 0;
}

// Decimals that leave a value so many digits: 99.99 becomes 100 with three, not 100.0.
int decimals_for(double value, int digits) {
  const int decimals = digits - 1 - exponent_of(std::abs(value));
  const bool carries =
      std::round(std::abs(value) * std::pow(10.0, decimals)) >= std::pow(10.0, digits);
  return carries ? decimals - 1 : decimals;
}

bool is_below(double value, double error) { return error > std::abs(value); }

double rounded_to(double value, int decimals) {
  const double power = std::pow(10.0, std::abs(decimals));
  return decimals >= 0 ? std::round(value * power) / power : std::round(value / power) * power;
}
// As they are printed: errors are rounded up.
bool is_printed_below(double value, const Rounding& rounding) {
  return is_below(rounded_to(value, rounding.decimals), rounding.rounded * (1.0 - rounding_slack));
}

constexpr std::size_t least_number_width = 4;
constexpr int digits_if_uncertain = 3;

// A value of a sub-impact, SI, none where the sub-impact has no end; its error likewise, none where
// it is not known.
using Number = std::optional<double>;
struct Quantity {
  const char* name;
  const char* before_unit;
  Measure measure;
  std::size_t least_width;
  int decimals;  // in the usual unit, without an error estimate
  bool is_instant;
  Number (*value)(const SubImpact&);
  Number (*error)(const SubImpact&);
};

Number duration(const SubImpact& s) { return s.end ? Number(*s.end - s.start) : std::nullopt; }
Number duration_error(const SubImpact& s) {
  return s.start_error && s.end_error ? Number(*s.start_error + *s.end_error) : std::nullopt;
}

// The larger of the errors of the body of start and end; none where it is not known.
Number body_error(const SubImpact& s) {
  const bool is_known =
      (s.start_body_error || s.start_error == 0.0) && (s.end_body_error || !s.end);
  return is_known ? std::max(s.start_body_error, s.end_body_error) : std::nullopt;
}

template <auto member>
Number in(const SubImpact& s) {
  return s.*member;
}

// clang-format off
constexpr Quantity quantities[] = {
    {"start", "", as_instant, 13, 4, true, in<&SubImpact::start>, in<&SubImpact::start_error>},
    {"end", "", as_instant, 13, 4, true, in<&SubImpact::end>, in<&SubImpact::end_error>},
    {"+- real", "", as_instant, least_number_width, 0, true, body_error, nullptr},
    {"duration", "", as_instant, 11, 4, false, duration, duration_error},
    {"peak force", "", as_force, 11, 2, false, in<&SubImpact::peak_force>, in<&SubImpact::peak_force_error>},
    {"impulse", "", as_impulse, 11, 6, false, in<&SubImpact::impulse>, in<&SubImpact::impulse_error>},
    {"indentation", "max, ", as_length, 12, 7, false, in<&SubImpact::max_indentation>, in<&SubImpact::max_indentation_error>},
    {"residual", "", as_length, 12, 7, false, in<&SubImpact::residual_indentation>, in<&SubImpact::residual_indentation_error>},
    {"striker", "", as_velocity, 11, 6, false, in<&SubImpact::striker_velocity>, in<&SubImpact::striker_velocity_error>},
    {"opening", "", as_gap, 9, 4, false, in<&SubImpact::opening>, in<&SubImpact::opening_error>},
};
// clang-format on

// A quantity of all rows: the unit that suits the largest, and how many decimals it has without an
// error estimate.
struct ColumnOfTable {
  const Quantity& quantity;
  ReadUnit unit;
  int decimals;
};

ColumnOfTable column_of(const Quantity& quantity, const Result& result) {
  double largest = quantity.is_instant ? result.outcome.time : 0.0;
  for (const SubImpact& s : result.sub_impacts) {
    largest = std::max(largest, std::abs(quantity.value(s).value_or(0.0)));
  }
  ReadUnit unit = unit_for(largest, quantity.measure);
  const bool is_usual = unit.name == unit_for(0.0, quantity.measure).name;
  const int decimals = is_usual ? quantity.decimals
                                : decimals_for(largest * unit.per_si, quantity.measure.most_digits);
  return {quantity, std::move(unit), decimals};
}

struct Cell {
  std::string value, error;
};

// An exact number shows the digits that it has: "0" for the first start.
std::string exact_text(double value, int decimals) {
  std::string text = with_decimals(value, decimals);
  if (text.find('.') == text.npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// A value that is not 0 is not printed as 0.
std::string rounded(double value, int decimals) {
  const std::string text = with_decimals(value, decimals);
  const bool is_zero = text.find_first_of("123456789") == text.npos;
  return is_zero && value != 0.0 ? with_digits(value, 2) : text;
}

// Decimals of an uncertain time, with which start and end of the contact differ.
int decimals_of_time(const Result& result, const SubImpact& s, const ReadUnit& unit) {
  const double length = unit.per_si * duration(s).value_or(0.0);
  const int of_run = decimals_of_times(result, unit);
  return length > 0.0 ? std::max(decimals_for(length, digits_if_uncertain), of_run) : of_run;
}

Cell cell_of(const ColumnOfTable& column, const Result& result, const SubImpact& s) {
  const auto& [quantity, unit, decimals] = column;
  if (!quantity.value(s)) return {};
  const double value = *quantity.value(s) * unit.per_si;
  if (quantity.value == body_error) return {with_digits(value, 2), {}};
  if (!result.error_estimate) return {with_decimals(value, decimals), {}};
  const double error = quantity.error(s).value_or(HUGE_VAL) * unit.per_si;
  const bool is_certain = s.certain.value_or(true);
  const int most = decimals_for(value, quantity.measure.most_digits);
  const int least = std::min(most, quantity.is_instant ? decimals_of_time(result, s, unit)
                                                       : decimals_for(value, digits_if_uncertain));
  const auto rounding = rounding_of(error, is_certain ? most : least);
  if (!rounding) {
    return {!is_certain && quantity.is_instant ? with_decimals(value, least)
                                               : with_digits(value, digits_if_uncertain),
            {}};
  }
  if (error == 0.0 && is_certain) return {exact_text(value, rounding->decimals), {}};
  const std::string text = rounded(value, rounding->decimals);
  if (is_below(value, error) || is_printed_below(value, *rounding)) return {"?", {}};
  const bool is_large = error > (is_certain ? silent_error : loud_error) * std::abs(value);
  const bool is_shown = !quantity.is_instant ? is_large : is_certain || rounding->decimals < least;
  return {text, is_shown ? rounding->error : std::string()};
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
    text.append(trailing, ' ');
    text = fmt::format("{:>{}}", text, before + after);
  }
}

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

std::string with_decimals(double value, int decimals) {
  if (decimals < 0) value = rounded_to(value, decimals);
  std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.front() == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);
  return text;
}

std::optional<Rounding> rounding_of(double error, int most_decimals) {
  if (!(error >= 0.0 && error < largest_error)) return std::nullopt;
  if (error == 0.0) return Rounding{most_decimals, 0.0, "0"};
  const auto rounded_up = [](double up, int decimals) {
    return Rounding{decimals, up, with_decimals(up, decimals)};
  };
  if (error <= std::pow(10.0, -most_decimals)) {
    return rounded_up(std::pow(10.0, -most_decimals), most_decimals);
  }
  int decimals = -static_cast<int>(std::floor(std::log10(error)));
  // 1.2 has two digits; 0.95 to 1 becomes 1.0 in tenths.
  if (units_up(error, decimals) <= 2.0 && units_up(error, decimals + 1) < 20.0) ++decimals;
  double units = units_up(error, decimals);
  if (units >= 100.0) {  // the logarithm was below a power of ten by rounding
    --decimals;
    units = units_up(error, decimals);
  }
  decimals = std::min(decimals, most_decimals);
  units = units_up(error, decimals);
  const double unit = std::pow(10.0, std::abs(decimals));
  return rounded_up(decimals >= 0 ? units / unit : units * unit, decimals);
}

std::string with_digits(double value, int digits) {
  const double size = std::abs(value);
  if (size > 0.0 && size < 1e-6) return fmt::format("{:.{}e}", value, digits - 1);
  if (!(size > 0.0 && std::isfinite(size))) return with_decimals(value, 0);
  return with_decimals(value, decimals_for(size, digits));
}

ReadUnit unit_for(double size, const Measure& measure) {
  const std::string_view si = measure.si;
  const double in_usual = size * std::pow(10.0, -measure.usual);
  const bool is_usual = !(size > 0.0 && std::isfinite(size)) ||
                        (in_usual >= measure.smallest && in_usual < measure.largest);
  const int whole = exponent_of(size);
  const int exponent = is_usual ? measure.usual : 3 * static_cast<int>(std::floor(whole / 3.0));
  const bool takes_large = si == as_force.si || si == as_energy.si;
  const int largest = std::max(takes_large ? largest_prefix : 0, measure.usual);
  if (exponent < smallest_prefix || exponent > largest || (si.empty() && !is_usual)) {
    return {fmt::format("1e{}{}{}", whole, si.empty() ? "" : " ", si), std::pow(10.0, -whole),
            true};
  }
  return {prefixes[(exponent - smallest_prefix) / 3] + std::string(si), std::pow(10.0, -exponent)};
}

std::string with_unit(const std::string& number, const ReadUnit& unit) {
  if (unit.name.empty()) return number;
  if (!unit.is_power) return number + " " + unit.name;
  const bool is_plain = number.find(' ') == number.npos;
  return (is_plain ? number : "(" + number + ")") + unit.name.substr(1);
}

std::string time_text(double seconds, int digits) {
  const ReadUnit unit = unit_for(std::abs(seconds), as_time);
  return with_unit(with_significant(unit.per_si * seconds, digits), unit);
}

std::string error_text(double seconds) {
  const bool in_ms = seconds >= 1e-3 && seconds < 1.0;
  const ReadUnit unit = in_ms ? ReadUnit{"ms", 1e3} : unit_for(seconds, as_time);
  const double error = unit.per_si * seconds;
  const auto rounding = rounding_of(error, decimals_for(error, as_time.most_digits));
  return rounding ? with_unit(rounding->error, unit) : "an unknown time";
}

SubImpactRows sub_impact_rows(const Result& result, const char* plus_minus) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  const bool has_errors = result.error_estimate.has_value();
  const bool has_marks = has_errors && result.n_certain() != all.size();
  SubImpactRows table;
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    table.rows.push_back({all[i].certain.value_or(true), {}});
    const char* mark = !has_marks ? "" : table.rows.back().is_certain ? " " : "?";
    numbers.push_back(fmt::format("{}{}", i + 1, mark));
  }
  const std::size_t number_width = numbers.empty() ? 0 : numbers.back().size();
  for (std::string& number : numbers) number = fmt::format("{:>{}}", number, number_width);
  const auto add_column = [&](SubImpactRows::Column column, std::vector<std::string> texts,
                              std::size_t width) {
    column.width = std::max(column.width, width);
    table.columns.push_back(column);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      table.rows[i].cells.push_back(std::move(texts[i]));
    }
  };
  add_column({"", "no.", least_number_width}, numbers, number_width);
  for (const Quantity& quantity : quantities) {
    const auto is_there = [&](const SubImpact& s) { return quantity.value(s).has_value(); };
    if (quantity.value == body_error && std::ranges::none_of(all, is_there)) continue;
    const ColumnOfTable column = column_of(quantity, result);
    std::vector<Cell> cells;
    for (const SubImpact& s : all) {
      cells.push_back(cell_of(column, result, s));
      if (quantity.value == in<&SubImpact::end> && !s.end) cells.back() = {"(open)", {}};
    }
    auto [texts, width] = column_texts(cells, plus_minus);
    add_column({quantity.name, quantity.before_unit + column.unit.name, quantity.least_width},
               std::move(texts), width);
  }
  return table;
}

ReadUnit unit_for(const Total& total, const Measure& measure) {
  const double size = std::abs(total.value), error = total.error.value_or(0.0);
  return unit_for(is_below(size, error) ? size + error : size, measure);
}

NumberAndError number_and_error(const ReadUnit& unit, const Total& total, int most_digits) {
  const double value = unit.per_si * total.value, size = std::abs(value);
  const double error = unit.per_si * total.error.value_or(HUGE_VAL);
  const bool is_lost = is_below(size, error);
  const int most = decimals_for(is_lost ? size + error : size, most_digits);
  const auto rounding = rounding_of(error, most);
  if (!rounding) return {with_digits(value, digits_if_uncertain), {}};
  if (is_lost || is_printed_below(value, *rounding)) {
    return {"at most " + rounding_of(size + error, most)->error, rounding->error, true};
  }
  return {rounded(value, rounding->decimals), rounding->error};
}

std::string number_in(const ReadUnit& unit, const Total& total, int most_digits) {
  const auto [number, error, is_lost] = number_and_error(unit, total, most_digits);
  if (error.empty()) return number;
  return is_lost ? fmt::format("? ({})", number) : fmt::format("{} +- {}", number, error);
}

std::string text_of(const Total& total, const Measure& measure) {
  const ReadUnit unit = unit_for(total, measure);
  return with_unit(number_in(unit, total, measure.most_digits), unit);
}

std::string rough_text(const Total& total, const Measure& measure) {
  const double size = std::abs(total.value);
  if (total.error && *total.error > silent_error * size) return text_of(total, measure);
  const ReadUnit unit = unit_for(size, measure);
  return with_unit(with_digits(unit.per_si * total.value, digits_if_uncertain), unit);
}

std::string plain_text(double value, const Measure& measure) {
  const ReadUnit unit = unit_for(std::abs(value), measure);
  return with_unit(with_digits(unit.per_si * value, measure.most_digits), unit);
}

int decimals_of_times(const Result& result, const ReadUnit& unit) {
  return decimals_for(unit.per_si * result.outcome.time, 5);
}

std::string count_text(const Total& count) {
  const double error = std::ceil(count.error.value_or(0.0));
  if (!(error > 0.0)) return fmt::format("{:.0f}", count.value);
  return is_below(count.value, error)
             ? fmt::format("{:.0f} here, at most {:.0f}", count.value, count.value + error)
             : fmt::format("{:.0f} +- {:.0f}", count.value, error);
}

std::string total_text(const Result& result, RunTotal name, double value, const Measure& measure) {
  if (!result.error_estimate) return plain_text(value, measure);
  const std::optional<double> error = error_of_total(result, name);
  const bool is_odd = !error && !result.error_estimate->totals.empty();
  return text_of({value, error}, measure) + (is_odd ? " (error not known)" : "");
}

std::string place_of_doubt(const Result& result, const ErrorEstimate& found) {
  const std::size_t i = *found.first_unresolved;
  if (result.sub_impacts.empty()) return "a touch";
  if (i >= result.sub_impacts.size()) return "after the last sub-impact";
  const ErrorEstimate::UncertainFlight* flight = result.error_estimate->doubt_after(i - 1);
  return flight && found.reason == flight->reason ? fmt::format("after sub-impact {}", i)
                                                  : fmt::format("sub-impact {}", i + 1);
}

}  // namespace subimpact
