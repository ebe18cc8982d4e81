#include "integrate/sundials/root_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace subimpact {
namespace {

// A value without a root.
constexpr double negative = -1.0;

// Far below the rounding of functions of order one. The library finds a change of sign by the
// product of two values, which must not underflow: its search would not end. Nor does it end where
// values overflow or are no numbers, as in a step that blew up.
constexpr double smallest = 1e-100;
constexpr double largest = 1e100;

double searchable(double value) {
  if (std::isnan(value)) return negative;
  if (std::abs(value) < smallest) return -smallest;
  return std::clamp(value, -largest, largest);
}

}  // namespace

int RootFinder::restart(void* memory, RootCalls::Function callback, std::span<const double> y) {
  if (!is_on()) return 0;
  const std::size_t n = functions_->size();
  values_.resize(n);
  root_.reset();
  root_at_restart_ = risen_function(y);
  flags_.assign(2 * n, 1);
  // The library keeps what it stored of functions whose number does not change.
  int flag = calls_.init(memory, 0, nullptr);
  if (flag != 0 || n == 0) return flag;
  flag = calls_.init(memory, static_cast<int>(2 * n), callback);
  if (flag == 0) flag = calls_.set_directions(memory, flags_.data());
  if (flag == 0) flag = calls_.set_no_warning(memory);
  return flag;
}

void RootFinder::evaluate(std::span<const double> y, sunrealtype* result) {
  const std::size_t n = values_.size();
  if (is_silent_) {
    std::fill_n(result, 2 * n, negative);
    return;
  }
  functions_->evaluate(y, values_);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [value, rate] = values_[i];
    result[i] = searchable(value);
    result[n + i] = searchable(-rate);
  }
}

std::optional<Integrator::Root> RootFinder::risen_function(std::span<const double> y) {
  functions_->evaluate(y, values_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto [value, rate] = values_[i];
    if (value > 0.0 && !(rate <= 0.0)) return Integrator::Root{i, 0.0};
  }
  return std::nullopt;
}

bool RootFinder::find_event(void* memory) {
  calls_.get_roots(memory, flags_.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (flags_[i] == 0) continue;
    root_ = Integrator::Root{i, tolerance(memory)};
    return true;
  }
  return false;
}

double RootFinder::tolerance(void* memory) const {
  sunrealtype time = 0.0, step = 0.0;
  calls_.get_current_time(memory, &time);
  calls_.get_last_step(memory, &step);
  return 100.0 * std::numeric_limits<double>::epsilon() * (std::abs(time) + std::abs(step));
}

bool RootFinder::is_at_end(void* memory, double reached) const {
  sunrealtype time = 0.0;
  calls_.get_current_time(memory, &time);
  return std::abs(time - reached) <= tolerance(memory);
}

}  // namespace subimpact
