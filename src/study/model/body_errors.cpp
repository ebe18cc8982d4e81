#include "subimpact/study/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "case/meshes.h"
#include "study/judgement/totals.h"
#include "study/model/body_runs.h"
#include "study/model/coarse_strike.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {
namespace {

constexpr double too_far = 3.0;    // a coarse run from the run itself, over what it shall show
constexpr double small = 0.1;      // of a sum of parts
constexpr double most_bias = 0.2;  // of a coarse mesh, in the force, that its ratio leaves out

using Number = std::optional<double>;
using Figure = Number StrikeFigures::*;
using Pair = std::array<Number, 2>;  // of start and end of a sub-impact

constexpr Figure times[] = {&StrikeFigures::parting, &StrikeFigures::contact_end,
                            &StrikeFigures::rests_since};

bool yields(const Result& result) { return result.n_yielded_sections > 0; }

// How far one run lies from another: nothing where one of them lacks the number.
Number distance(const Number& a, const Number& b) {
  return a && b ? Number(std::abs(*a - *b)) : std::nullopt;
}

// What a part or a sum of parts changes.
struct Changes {
  StrikeFigures figures;
  std::vector<Pair> rows;
  StrikeFigures coarse = {};  // how far the runs that show them lie from the run itself

  // Calls `use` with each number of this one and of another.
  template <class Use>
  void zip(Changes& other, Use use) {
    for (const Figure figure : strike_figures) use(figures.*figure, other.figures.*figure);
    for (std::size_t z = 0; z < figures.zones.size(); ++z) {
      for (const auto member : zone_figures) {
        use(figures.zones[z].*member, other.figures.zones[z].*member);
      }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const std::size_t k : {0, 1}) use(rows[i][k], other.rows[i][k]);
    }
  }
};

Case with_elastic_contact(Case input) {
  input.scene.beam.yield_stress = HUGE_VAL;
  input.scene.contact.yield_pressure.reset();
  input.scene.contact.pressure_by_depth = false;
  return input;
}

Number first_touch(const Result& run) {
  return run.sub_impacts.empty() ? Number() : Number(run.sub_impacts.front().start);
}

// The opening after the contact that ends nearest to a time; 0 if there is none.
double opening_near(double time, const Result& run) {
  double opening = 0.0, nearest = HUGE_VAL;
  for (const SubImpact& s : run.sub_impacts) {
    if (!s.end || !s.opening || std::abs(*s.end - time) >= nearest) continue;
    nearest = std::abs(*s.end - time);
    opening = *s.opening;
  }
  return opening;
}

class Study {
 public:
  Study(const Case& input, const Result& result, const Progress& progress)
      : input_(input), result_(result), progress_(progress) {
    errors_.value = figures_of(result);
    if (!yields(result)) {
      errors_.value.permanent_set.reset();
      input_.model.section = SectionKind::elastic;
    }
    if (input.scene.striker.fixed) errors_.value.striker_velocity.reset();
    if (!result.contact_over) errors_.value.contact_end.reset();
    touch_ = result.sub_impacts.front().start;
    energy_ = std::max(result.used.initial_energy, 0.0) + std::max(result.final_energies.work, 0.0);
    largest_force_ = largest_possible_force(with_elastic_contact(input_), result);
    variants_ = body_variants(input_, yields(result));
  }

  /// Whether it was not stopped.
  bool run() {
    double n_runs = 2.0;
    for (const BodyVariant& variant : variants_) {
      n_runs += static_cast<double>(variant.cases.size()) + (variant.base ? 1.0 : 0.0);
    }
    runs_.emplace(input_, result_, value().parting, n_runs, progress_);
    for (const BodyVariant& variant : variants_) {
      parts_.emplace_back(variant.kind, changes_by(variant));
      cap(parts_.back().second.figures);
    }
    add_estimates();
    add_openings();
    for (const Figure figure : strike_figures) forget_hidden(figure);
    sum_ = at_least_ = unchanged();
    for (auto& [kind, changes] : parts_) sum_up(kind, changes);
    errors_.error = sum_.figures;
    errors_.at_least = at_least_.figures;
    cap(errors_.error);
    cap(errors_.at_least);
    return !runs_->is_stopped();
  }

  void store(Result& result) {
    for (std::size_t i = 0; i < sum_.rows.size(); ++i) {
      result.sub_impacts[i].start_body_error = sum_.rows[i][0];
      result.sub_impacts[i].end_body_error = sum_.rows[i][1];
    }
    result.body_errors = std::move(errors_);
  }

 private:
  const StrikeFigures& value() const { return errors_.value; }

  // 0 where the run has a number.
  Changes unchanged() const {
    Changes changes{value(), {}};
    for (const SubImpact& s : result_.sub_impacts) changes.rows.push_back({s.start, s.end});
    Changes same = changes;
    changes.zip(same, [](Number& number, Number&) {
      if (number) *number = 0.0;
    });
    return changes;
  }

  // The time (s) at which a figure is decided; infinite: at the end.
  double decided(Figure figure) const {
    const auto largest = [&](double SubImpact::*number) {
      return std::ranges::max_element(result_.sub_impacts, {}, number)->peak_time;
    };
    if (figure == &StrikeFigures::parting) return *value().parting;
    if (figure == &StrikeFigures::peak_force) return largest(&SubImpact::peak_force);
    if (figure == &StrikeFigures::max_indentation) return largest(&SubImpact::max_indentation);
    return HUGE_VAL;
  }

  // Of one run beside the base of its horizon. What does not lie within the horizon stays as it is.
  void change(const BodyRuns::Horizon& horizon, const Result& from, const Result& other,
              Changes& changes) {
    const bool is_whole = &horizon == &runs_->horizons().back();
    const bool has_early = is_whole && runs_->horizons().size() > 1;
    const StrikeFigures base = figures_of(from), with = figures_of(other);
    const StrikeFigures base_early = figures_of(from, runs_->until()),
                        other_early = figures_of(other, runs_->until());
    for (const Figure figure : strike_figures) {
      if (!(value().*figure)) continue;
      Number& number = changes.figures.*figure;
      const bool early = decided(figure) <= runs_->until();
      const bool is_largest =
          figure == &StrikeFigures::peak_force || figure == &StrikeFigures::max_indentation;
      const bool exceeds = is_largest && with.*figure > other_early.*figure;
      const bool is_later = early && has_early && (!number || exceeds);
      if (early ? has_early && !is_later : !is_whole) continue;
      const StrikeFigures& one = early && !is_later ? base_early : base;
      const StrikeFigures& two = early && !is_later ? other_early : with;
      Number by = distance(one.*figure, two.*figure);
      Number coarse = distance(one.*figure, value().*figure);
      // Coarse meshes bias the force, less so its ratio.
      if (by && figure == &StrikeFigures::peak_force && *one.peak_force > 0.0) {
        *by *= *value().peak_force / *one.peak_force;
        *coarse -= most_bias * *value().peak_force;
      }
      number = is_later ? std::max(number, by) : by;
      changes.coarse.*figure = std::max(changes.coarse.*figure, coarse);
    }
    const std::vector<ZoneFigures>&before = base.zones, &after = with.zones;
    for (std::size_t z = 0; is_whole && z < changes.figures.zones.size(); ++z) {
      const bool is_there = z < before.size() && z < after.size();
      for (const auto member : zone_figures) {
        if (!(value().zones[z].*member)) continue;
        changes.figures.zones[z].*member =
            is_there ? distance(before[z].*member, after[z].*member) : std::nullopt;
      }
    }
    const Counterparts in_base = counterparts(result_.sub_impacts, from.sub_impacts),
                       in_other = counterparts(from.sub_impacts, other.sub_impacts);
    for (std::size_t i = 0; i < changes.rows.size(); ++i) {
      const bool ends_early = result_.end_of(result_.sub_impacts[i]) <= runs_->until();
      if (ends_early ? has_early : !is_whole) continue;
      const SubImpact* one = in_base.of[i];
      const SubImpact* two =
          one ? in_other.of[static_cast<std::size_t>(one - from.sub_impacts.data())] : nullptr;
      changes.rows[i][0] = two ? distance(one->start, two->start) : std::nullopt;
      if (i == 0) changes.rows[i][0] = distance(first_touch(from), first_touch(other));
      if (!result_.sub_impacts[i].end) continue;
      changes.rows[i][1] = two ? distance(one->end, two->end) : std::nullopt;
    }
  }

  Changes changes_by(const BodyVariant& variant) {
    Changes unknown{{}, std::vector<Pair>(result_.sub_impacts.size())};
    unknown.figures.zones.resize(value().zones.size());
    if (variant.cases.empty()) return unknown;
    std::vector<std::optional<Result>> own;
    for (const BodyRuns::Horizon& horizon : runs_->horizons()) {
      if (variant.base) own.push_back(runs_->on_cells(*variant.base, horizon));
    }
    Changes largest = unchanged();
    double of_opening = 0.0;
    for (const Case& other : variant.cases) {
      Changes changes = unchanged();
      for (std::size_t h = 0; h < runs_->horizons().size(); ++h) {
        const BodyRuns::Horizon& horizon = runs_->horizons()[h];
        const std::optional<Result>& base = variant.base ? own[h] : horizon.base;
        const auto run =
            base ? variant.base ? runs_->on_cells(other, horizon) : runs_->on_mesh(other, horizon)
                 : std::nullopt;
        if (!run) return unknown;
        change(horizon, *base, *run, changes);
        if (!value().parting || h > 0) continue;
        of_opening = std::max(of_opening, std::abs(opening_near(*value().parting, *run) -
                                                   opening_near(*value().parting, *base)));
      }
      largest.zip(changes, [](Number& most, const Number& by) {
        if (most) most = by ? Number(std::max(*most, *by)) : std::nullopt;
      });
      for (const Figure figure : strike_figures) {
        largest.coarse.*figure = std::max(largest.coarse.*figure, changes.coarse.*figure);
      }
    }
    change_of_opening_ += of_opening;
    return largest;
  }

  // Changes that coarse runs cannot show, for they differ from the run itself by more than these
  // and than what is small beside all of them.
  void forget_hidden(Figure figure) {
    double sum = 0.0;
    for (const auto& [kind, changes] : parts_) sum += (changes.figures.*figure).value_or(0.0);
    for (auto& [kind, changes] : parts_) {
      Number& change = changes.figures.*figure;
      const double least = std::max(change.value_or(0.0), small * sum);
      if (changes.coarse.*figure > too_far * least) change.reset();
    }
  }

  // No more than energy and momentum allow.
  void cap(StrikeFigures& changes) const {
    const auto limit = [](Number& change, double largest) {
      if (change) change = std::min(*change, largest);
    };
    const double force = result_.max_force;
    limit(changes.peak_force, std::max(force, largest_force_ - force));
    if (input_.scene.striker.fixed) return;
    const double velocity = std::sqrt(2.0 * energy_ / input_.scene.striker.mass);
    limit(changes.striker_velocity, velocity + std::abs(result_.striker_velocity));
  }

  void sum_up(BodyPart kind, Changes& changes) {
    const auto sum = [&](Changes& to, bool needs_all) {
      to.zip(changes, [&](Number& total, const Number& change) {
        if (total && (change || needs_all))
          total = change ? Number(*total + *change) : std::nullopt;
      });
    };
    sum(sum_, true);
    sum(at_least_, false);
    errors_.parts.push_back({kind, changes.figures});
  }

  // The largest rotation (rad) up to a time (s), or where that is not known up to the end.
  double rotation_until(double time) {
    if (time <= touch_) return 0.0;
    if (time >= result_.outcome.time || input_.strikes > 1) return result_.largest_rotation;
    BodyRuns::Horizon until = runs_->horizons().front();
    until.end = time;
    const std::optional<Result> run = runs_->on_mesh(input_, until);
    return run ? run->largest_rotation : result_.largest_rotation;
  }

  // A change by a share of each number, that up to its time; of times by one of that since the
  // first touch.
  template <class Share>
  Changes by_share(Share share) {
    Changes changes = unchanged();
    const auto of_time = [&](Number& change, double time) {
      if (change) change = share(time) * (time - touch_);
    };
    for (const Figure figure : strike_figures) {
      if (!(value().*figure)) continue;
      const double size = std::abs(*(value().*figure));
      const bool is_time = std::ranges::count(times, figure) > 0;
      if (is_time) of_time(changes.figures.*figure, size);
      if (!is_time) changes.figures.*figure = share(decided(figure)) * size;
    }
    for (std::size_t z = 0; z < changes.figures.zones.size(); ++z) {
      ZoneFigures& zone = changes.figures.zones[z];
      of_time(zone.start, *value().zones[z].start);
      if (zone.end) of_time(zone.end, *value().zones[z].end);
      zone.impulse = share(HUGE_VAL) * std::abs(*value().zones[z].impulse);
    }
    for (std::size_t i = 0; i < changes.rows.size(); ++i) {
      of_time(changes.rows[i][0], result_.sub_impacts[i].start);
      if (result_.sub_impacts[i].end) of_time(changes.rows[i][1], *result_.sub_impacts[i].end);
    }
    return changes;
  }

  void add_estimates() {
    const Beam& beam = input_.scene.beam;
    if (beam.fixed) return;
    const double peak = decided(&StrikeFigures::peak_force);
    const double parting = value().parting.value_or(0.0);
    const double at_peak = rotation_until(peak);
    const double at_parting = parting > peak ? rotation_until(parting) : at_peak;
    parts_.emplace_back(BodyPart::finite_rotations, by_share([&](double time) {
                          const double rotation = time <= peak      ? at_peak
                                                  : time <= parting ? at_parting
                                                                    : result_.largest_rotation;
                          return rotation * rotation;
                        }));
    if (!yields(result_)) return;
    Changes hinge = unchanged();
    const double rotation = largest_magnitude(result_.plastic_zones, &PlasticZone::rotation);
    if (value().permanent_set) hinge.figures.permanent_set = rotation * beam.height() / 8.0;
    parts_.emplace_back(BodyPart::hinge_length, std::move(hinge));
  }

  // How far the parting moves if openings are wrong by as much as the variants change that one.
  void add_openings() {
    if (!value().parting) return;
    double furthest = 0.0;
    for (const SubImpact& s : result_.sub_impacts) {
      if (!s.end || !s.opening || *s.opening + change_of_opening_ <= hair_opening) continue;
      furthest = std::max(furthest, std::abs(*s.end - *value().parting));
      if (*s.opening - change_of_opening_ > hair_opening) break;
    }
    Changes openings = unchanged();
    openings.figures.parting = furthest;
    parts_.emplace_back(BodyPart::thin_openings, std::move(openings));
  }

  Case input_;
  const Result& result_;
  const Progress& progress_;
  std::vector<BodyVariant> variants_;
  std::optional<BodyRuns> runs_;
  BodyErrors errors_;
  std::vector<std::pair<BodyPart, Changes>> parts_;
  Changes sum_, at_least_;
  double energy_ = 0.0, largest_force_ = 0.0;  // J, N
  double touch_ = 0.0;                         // s
  double change_of_opening_ = 0.0;             // m, of the parting
};

}  // namespace

void add_body_errors(const Case& input, Result& result, const Progress& progress) {
  const CaseParts& own = input.parts;
  if (own.mesh || own.contact_law || own.section || own.start || result.sub_impacts.empty() ||
      !result.outcome.completed()) {
    return;
  }
  Study study(input, result, progress);
  if (study.run()) study.store(result);
}

}  // namespace subimpact
