#include "report/uncertain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numerics/units.h"

namespace subimpact {
namespace {

constexpr double largest_error = 1e15;
constexpr double rounding_slack = 1e-9;    // of a digit: 0.3 is three units of 0.1, not four
constexpr int most_decimals_of_times = 6;  // of us: 1 ps

// Units of 10^-decimals, rounded up.
double units_up(double error, int decimals) {
  const double power = std::pow(10.0, std::abs(decimals));
  return std::ceil((decimals >= 0 ? error * power : error / power) - rounding_slack);
}

constexpr std::size_t least_number_width = 4;
constexpr int digits_if_uncertain = 3;

// A value of a sub-impact in its unit, none where the sub-impact has no end; its error likewise,
// none where it is not known.
using Number = std::optional<double>;
struct Quantity {
  const char* name;
  const char* unit;
  std::size_t least_width;
  int decimals;       // without an error estimate
  int most_decimals;  // with one
  bool is_instant;
  Number (*value)(const SubImpact&);
  Number (*error)(const SubImpact&);
};

Number scaled(const Number& value, double factor) {
  return value ? Number(*value * factor) : std::nullopt;
}

Number duration(const SubImpact& s) {
  return s.end ? Number((*s.end - s.start) * us) : std::nullopt;
}
Number duration_error(const SubImpact& s) {
  return s.start_error && s.end_error ? Number((*s.start_error + *s.end_error) * us) : std::nullopt;
}

constexpr double as_it_is = 1.0;
template <auto member, const double& factor = as_it_is>
Number in(const SubImpact& s) {
  return scaled(s.*member, factor);
}

// clang-format off
constexpr Quantity quantities[] = {
    {"start", "us", 13, 4, 6, true, in<&SubImpact::start, us>, in<&SubImpact::start_error, us>},
    {"end", "us", 13, 4, 6, true, in<&SubImpact::end, us>, in<&SubImpact::end_error, us>},
    {"duration", "us", 11, 4, 6, false, duration, duration_error},
    {"peak force", "N", 11, 2, 2, false, in<&SubImpact::peak_force>, in<&SubImpact::peak_force_error>},
    {"impulse", "N s", 11, 6, 6, false, in<&SubImpact::impulse>, in<&SubImpact::impulse_error>},
    {"indentation", "max, mm", 12, 7, 7, false, in<&SubImpact::max_indentation, mm>, in<&SubImpact::max_indentation_error, mm>},
    {"residual", "mm", 12, 7, 7, false, in<&SubImpact::residual_indentation, mm>, in<&SubImpact::residual_indentation_error, mm>},
    {"striker", "m/s", 11, 6, 6, false, in<&SubImpact::striker_velocity>, in<&SubImpact::striker_velocity_error>},
};
// clang-format on

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

// Decimals with which the start and the end of a contact differ.
int decimals_of_times(const SubImpact& s) {
  if (!s.end) return 1;
  const double length = *duration(s);
  if (!(length > 0.0)) return quantities[0].most_decimals;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(length))), 1,
                    quantities[0].most_decimals);
}

Cell cell_of(const Quantity& quantity, const SubImpact& s, bool has_errors) {
  const Number value = quantity.value(s);
  if (!value) return {};
  if (!has_errors) return {with_decimals(*value, quantity.decimals), {}};
  if (!s.certain.value_or(true)) {
    return {quantity.is_instant ? with_decimals(*value, decimals_of_times(s))
                                : with_digits(*value, digits_if_uncertain),
            {}};
  }
  const Number error = quantity.error(s);
  const auto rounding = rounding_of(error.value_or(HUGE_VAL), quantity.most_decimals);
  if (!rounding) return {with_digits(*value, digits_if_uncertain), {}};
  if (*error == 0.0) return {exact_text(*value, rounding->decimals), {}};
  return {rounded(*value, rounding->decimals),
          quantity.is_instant ? rounding->error : std::string()};
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
  if (decimals < 0) {
    const double unit = std::pow(10.0, -decimals);
    value = std::round(value / unit) * unit;
  }
  std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.front() == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);
  return text;
}

std::optional<Rounding> rounding_of(double error, int most_decimals) {
  if (!(error >= 0.0 && error < largest_error)) return std::nullopt;
  if (error == 0.0) return Rounding{most_decimals, "0"};
  if (error <= std::pow(10.0, -most_decimals)) {
    return Rounding{most_decimals, with_decimals(std::pow(10.0, -most_decimals), most_decimals)};
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
  return Rounding{decimals, with_decimals(decimals >= 0 ? units / unit : units * unit, decimals)};
}

std::string with_digits(double value, int digits) {
  const double size = std::abs(value);
  if (size > 0.0 && size < 1e-6) return fmt::format("{:.{}e}", value, digits - 1);
  if (!(size > 0.0 && std::isfinite(size))) return with_decimals(value, 0);
  int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size)));
  // 99.99 becomes 100 with three digits, not 100.0.
  if (std::round(size * std::pow(10.0, decimals)) >= std::pow(10.0, digits)) --decimals;
  return with_decimals(value, decimals);
}

std::string error_text(double seconds) {
  const bool in_ms = seconds >= 1e-3;
  const auto rounding = rounding_of((in_ms ? 1e3 : 1e6) * seconds, most_decimals_of_times);
  if (!rounding) return "an unknown time";
  return rounding->error + (in_ms ? " ms" : " us");
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
    std::vector<Cell> cells;
    for (const SubImpact& s : all) {
      cells.push_back(cell_of(quantity, s, has_errors));
      if (quantity.name == std::string_view("end") && !s.end) cells.back() = {"(open)", {}};
    }
    auto [texts, width] = column_texts(cells, plus_minus);
    add_column({quantity.name, quantity.unit, quantity.least_width}, std::move(texts), width);
  }
  return table;
}

std::string text_of(const Total& total, double factor, int decimals) {
  const double value = total.value * factor;
  const auto rounding = rounding_of(total.error.value_or(HUGE_VAL) * factor, decimals);
  if (!rounding) return with_digits(value, digits_if_uncertain);
  return fmt::format("{} +- {}", rounded(value, rounding->decimals), rounding->error);
}

std::optional<double> error_of_total(const Result& result, std::string_view name) {
  if (!result.error_estimate) return std::nullopt;
  const auto& totals = result.error_estimate->totals;
  const auto found = std::ranges::find(totals, name, &NamedTotal::name);
  return found == totals.end() ? std::nullopt : found->total.error;
}

std::string total_text(const Result& result, const char* name, double value, double factor,
                       int decimals, const char* unit) {
  const std::string in_unit = *unit ? std::string(" ") + unit : std::string();
  if (!result.error_estimate) return fmt::format("{:.{}f}{}", factor * value, decimals, in_unit);
  return text_of({value, error_of_total(result, name)}, factor, decimals) + in_unit;
}

std::string place_of_doubt(const Result& result, std::size_t first_unresolved,
                           const std::string& reason) {
  if (first_unresolved >= result.sub_impacts.size()) return "after the last sub-impact";
  const auto is_there = [&](const ErrorEstimate::UncertainFlight& flight) {
    return flight.after + 1 == first_unresolved && reason.ends_with(flight.reason);
  };
  return std::ranges::any_of(result.error_estimate->uncertain_flights, is_there)
             ? fmt::format("after sub-impact {}", first_unresolved)
             : fmt::format("sub-impact {}", first_unresolved + 1);
}

}  // namespace subimpact
