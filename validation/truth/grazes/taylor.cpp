#include "taylor.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace grazes {
namespace {

constexpr int order = 20;
constexpr int deepest = 60;  // bisections of a step
using Polynomial = std::vector<double>;

double value_at(std::span<const double> c, double u) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 0;) sum = sum * u + c[i];
  return sum;
}

// p(u) becomes p(u + 1).
void shift_by_one(Polynomial& p) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    for (std::size_t j = p.size() - 1; j-- > i;) p[j] += p[j + 1];
  }
}

// Descartes: an upper bound of the number of roots in (0, 1), right if it is 0 or 1.
int sign_changes_in_unit(const Polynomial& p) {
  Polynomial q(p.rbegin(), p.rend());  // u^n p(1/u)
  shift_by_one(q);
  int changes = 0;
  double last = 0.0;
  for (const double c : q) {
    if (c == 0.0) continue;
    if (last * c < 0.0) ++changes;
    last = c > 0.0 ? 1.0 : -1.0;
  }
  return changes;
}

struct Bracket {
  double lower, upper;
};

// The first root in (0, 1], in a bracket with no other.
std::optional<Bracket> first_root(const Polynomial& whole) {
  struct Part {
    double start, width;
    int depth;
    Polynomial p;
  };
  std::vector<Part> parts{{0.0, 1.0, 0, whole}};
  while (!parts.empty()) {
    Part part = std::move(parts.back());
    parts.pop_back();
    const int changes = sign_changes_in_unit(part.p);
    if (changes == 0) continue;
    if (changes == 1) return Bracket{part.start, part.start + part.width};
    if (part.depth == deepest) continue;  // a double root, or none, to rounding
    const double half = 0.5 * part.width;
    Polynomial left = part.p;
    double factor = 1.0;
    for (double& c : left) {
      c *= factor;
      factor *= 0.5;
    }
    Polynomial right = left;
    shift_by_one(right);
    parts.push_back({part.start + half, half, part.depth + 1, std::move(right)});
    parts.push_back({part.start, half, part.depth + 1, std::move(left)});
  }
  return std::nullopt;
}

double refined(std::span<const double> p, Bracket bracket) {
  const bool rises = value_at(p, bracket.upper) > 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (bracket.lower + bracket.upper);
    if (middle <= bracket.lower || middle >= bracket.upper) break;
    ((value_at(p, middle) > 0.0) == rises ? bracket.upper : bracket.lower) = middle;
  }
  return 0.5 * (bracket.lower + bracket.upper);
}

class Series {
 public:
  explicit Series(const Scene& scene)
      : scene_(scene),
        n_(scene.modes.size()),
        terms_((n_ + 1) * (order + 1)),
        indentation_(order + 1),
        scale_(scene.velocity / scene.fastest()) {
    coefficient(n_, 1) = scene.velocity;
  }

  // Terms two and above from the first two. Returns the length of the step.
  double expand(bool closed) {
    for (int i = 0; i <= order; ++i) {
      indentation_[i] = coefficient(n_, i);
      for (std::size_t k = 0; k < n_; ++k) {
        indentation_[i] -= scene_.modes[k].displacement * coefficient(k, i);
      }
      if (i + 2 > order) continue;
      const double force = closed ? scene_.stiffness * indentation_[i] : 0.0;
      const double divisor = (i + 1.0) * (i + 2.0);
      for (std::size_t k = 0; k < n_; ++k) {
        const Mode& mode = scene_.modes[k];
        coefficient(k, i + 2) = (mode.displacement * force - mode.stiffness * coefficient(k, i)) /
                                (mode.mass * divisor);
      }
      coefficient(n_, i + 2) = -force / (scene_.striker_mass * divisor);
    }
    double h = HUGE_VAL;
    for (const int i : {order - 1, order}) {
      double largest = 0.0;
      for (std::size_t k = 0; k <= n_; ++k) {
        const double weight = k < n_ ? scene_.modes[k].displacement : 1.0;
        largest = std::max(largest, std::abs(weight * coefficient(k, i)));
      }
      if (largest > 0.0) h = std::min(h, std::pow(scale_ / largest, 1.0 / i));
    }
    constexpr double e2 = 7.389056098930650;
    return std::min(h / e2, 1.0 / scene_.highest_frequency());
  }

  // The indentation over the step in units of its length.
  Polynomial over(double h) const {
    Polynomial p = indentation_;
    double factor = 1.0;
    for (double& c : p) {
      c *= factor;
      factor *= h;
    }
    return p;
  }

  void advance(double h) {
    for (std::size_t k = 0; k <= n_; ++k) {
      double position = 0.0;
      double velocity = 0.0;
      for (int i = order; i >= 0; --i) {
        position = position * h + coefficient(k, i);
        if (i > 0) velocity = velocity * h + i * coefficient(k, i);
      }
      coefficient(k, 0) = position;
      coefficient(k, 1) = velocity;
    }
  }

 private:
  double& coefficient(std::size_t k, int i) {
    return terms_[k * (order + 1) + static_cast<std::size_t>(i)];
  }

  const Scene& scene_;
  std::size_t n_;
  std::vector<double> terms_;
  Polynomial indentation_;
  double scale_;
};

// Whether the first coefficient outweighs all others.
bool has_no_root(const Polynomial& p) {
  double others = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) others += std::abs(p[i]);
  return std::abs(p[0]) > others;
}

}  // namespace

std::vector<Event> events_by_taylor_series(const Scene& scene) {
  Series series(scene);
  std::vector<Event> events;
  bool closed = true;
  bool at_event = true;
  double t = 0.0;
  while (t < scene.end) {
    double h = std::min(series.expand(closed), scene.end - t);
    Polynomial p = series.over(h);
    if (at_event) p.erase(p.begin());
    at_event = false;
    std::optional<Bracket> bracket;
    if (!has_no_root(p)) bracket = first_root(p);
    if (bracket) {
      const double u = refined(p, *bracket);
      h *= u;
      events.push_back({!closed, t + h});
      closed = !closed;
      at_event = true;
    }
    series.advance(h);
    t += h;
  }
  return events;
}

}  // namespace grazes
