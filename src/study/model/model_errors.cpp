#include "subimpact/study/model/model_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "case/meshes.h"
#include "case/problem.h"
#include "study/judgement/totals.h"
#include "study/model/coarse_strike.h"
#include "study/refinement/refinement.h"
#include "subimpact/study/model/scene_choice.h"

namespace subimpact {
namespace {

constexpr double share_of_work = 0.25;
constexpr double least_work = 4e6;  // some 20 ms
constexpr double dearer = 4.0;      // an evaluation on few cells that yield, over one on many
constexpr int most_cells = 481;
constexpr double larger_coefficient = 1.02;
constexpr double fully_plastic = 2.8;  // mean pressure over yield stress
constexpr double deeper = 1.03;        // the error of Boussinesq's root there is 2.7 %

using Figure = std::optional<double> StrikeFigures::*;
constexpr Figure figures[] = {&StrikeFigures::parting, &StrikeFigures::peak_force,
                              &StrikeFigures::striker_velocity, &StrikeFigures::permanent_set};

struct Variant {
  std::string name, compared;
  std::vector<Case> cases;  // none: nothing to compare with
};

bool yields(const Result& result) { return result.n_yielded_sections > 0; }

Variant shear_of(const Case& input) {
  Case other = input;
  Beam& beam = other.scene.beam;
  if (beam.shears()) {
    beam.shear_coefficient = std::min(1.0, larger_coefficient * beam.used_shear_coefficient());
    return {"shear coefficient", "one larger by 2 %", {other}};
  }
  beam.theory = BeamTheory::timoshenko;
  if (!input.scene.beam_poisson()) beam.poisson = usual_poisson;
  if (!beam.poisson) beam.poisson = input.scene.beam_poisson();
  return {"shear", "the beam with shear", {other}};
}

// The scene with a contact law that follows from another scene.
template <class Change>
Case with_law_of(const Case& input, Change change) {
  Case other = input;
  Scene scene = input.scene;
  change(scene);
  other.parts.contact_law = make_contact_law(scene);
  return other;
}

Variant law_of(const Case& input) {
  const Contact& contact = input.scene.contact;
  if (contact.stiffness) return {"contact law", "nothing: its stiffness is given", {}};
  if (contact.kind == ContactKind::curve) return {"contact law", "nothing: it is measured", {}};
  if (!contact.is_from_mid_plane()) {
    Case next = input;
    choose_scene(next, {{"beam.theory"}, {}});
    const Contact& better = next.scene.contact;
    if (better.kind == contact.kind && better.indentation == contact.indentation) {
      return {"contact law", "nothing: no better one is known", {}};
    }
    return {"contact law", "the one that the scene needs", {next}};
  }
  const bool is_line = contact.kind == ContactKind::line;
  Variant variant{"contact law", is_line ? "plane stress" : "a mid-plane 3 % deeper", {}};
  variant.cases.push_back(with_law_of(input, [&](Scene& scene) {
    Beam& beam = scene.beam;
    if (is_line) {
      beam.poisson = scene.contact.beam_poisson = 0.0;
    } else {
      beam.thickness *= deeper;
      if (beam.section.height) *beam.section.height *= deeper;
    }
  }));
  if (contact.kind == ContactKind::hertz || std::isinf(input.scene.beam.yield_stress)) {
    return variant;
  }
  const double first = is_line ? yield_pressure_over_stress_of_line : yield_pressure_over_stress;
  variant.compared += fmt::format(", yield pressures of {:.2f} and {:.1f} Y", first, fully_plastic);
  for (const double share : {first, fully_plastic}) {
    variant.cases.push_back(with_law_of(input, [&](Scene& scene) {
      scene.contact.pressure_by_depth = false;
      scene.contact.yield_pressure = share * scene.beam.yield_stress;
    }));
  }
  return variant;
}

// Sections held sideways, the contact as it is.
Variant width_of(const Case& input) {
  Case other = input;
  other.parts.contact_law = contact_law_of(input);
  other.scene.beam.yield_stress *= 2.0 / std::numbers::sqrt3;
  return {"width", "a hinge held sideways, at 2 Y/sqrt(3)", {other}};
}

std::vector<Variant> variants_of(const Case& input, const Result& result) {
  std::vector<Variant> variants = {shear_of(input), law_of(input)};
  if (yields(result)) variants.push_back(width_of(input));
  return variants;
}

// The largest change of each figure; nothing where one of the runs does not have it.
StrikeFigures changes(const StrikeFigures& base, const std::vector<StrikeFigures>& others,
                      const StrikeFigures& value) {
  StrikeFigures change;
  for (const Figure figure : figures) {
    if (!(base.*figure) || others.empty()) continue;
    double largest = 0.0;
    const bool is_known = std::ranges::all_of(others, [&](const StrikeFigures& other) {
      if (!(other.*figure)) return false;
      largest = std::max(largest, std::abs(*(other.*figure) - *(base.*figure)));
      return true;
    });
    if (is_known) change.*figure = largest;
  }
  // Coarse meshes bias the force, less so its ratio.
  if (change.peak_force && *base.peak_force > 0.0) {
    *change.peak_force *= value.peak_force.value_or(0.0) / *base.peak_force;
  }
  return change;
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
    if (!yields(result)) errors_.value.permanent_set.reset();
    if (input.scene.striker.fixed) errors_.value.striker_velocity.reset();
  }

  /// Nothing where it is stopped.
  std::optional<ModelErrors> errors() {
    add_variants();
    add_estimates();
    add_openings();
    for (const Figure figure : figures) {
      if (!(value().*figure)) continue;
      for (const ModelErrors::Part& part : errors_.parts) {
        if (!(part.change.*figure)) continue;
        errors_.error.*figure = (errors_.error.*figure).value_or(0.0) + *(part.change.*figure);
      }
    }
    return is_stopped_ ? std::nullopt : std::optional(std::move(errors_));
  }

 private:
  const StrikeFigures& value() const { return errors_.value; }

  std::optional<Result> on_cells(const Case& of, double end) {
    if (cells_ == 0 || is_stopped_) return std::nullopt;
    std::optional<Result> run = coarse_run(coarse_case(of, cells_, end), progress_);
    is_stopped_ = run && run->outcome.kind == OutcomeKind::stopped;
    return run && run->outcome.completed() ? std::move(run) : std::nullopt;
  }

  void add_variants() {
    const std::vector<Variant> variants = variants_of(input_, result_);
    double n_runs = 1.0;
    for (const Variant& variant : variants) n_runs += static_cast<double>(variant.cases.size());
    const double all =
        std::max(share_of_work * work_with_others * counted_work(input_, result_), least_work);
    cells_ = affordable_cells(input_, input_.end_time, most_cells, all / (dearer * n_runs));
    const std::optional<Result> base = on_cells(input_, input_.end_time);
    for (const Variant& variant : variants) {
      std::vector<StrikeFigures> others;
      double of_opening = 0.0;
      for (const Case& other : variant.cases) {
        const auto run = base ? on_cells(other, input_.end_time) : std::nullopt;
        if (!run) continue;
        others.push_back(figures_of(*run));
        if (!value().parting) continue;
        of_opening = std::max(of_opening, std::abs(opening_near(*value().parting, *run) -
                                                   opening_near(*value().parting, *base)));
      }
      change_of_opening_ += of_opening;
      ModelErrors::Part& part =
          errors_.parts.emplace_back(ModelErrors::Part{variant.name, variant.compared});
      if (base && others.size() == variant.cases.size()) {
        part.change = changes(figures_of(*base), others, value());
      }
    }
  }

  // The largest rotation (rad) and displacement (m) up to the time at which a figure is decided.
  std::pair<double, double> deformation_at(Figure figure) {
    std::optional<Result> run;
    if (figure == &StrikeFigures::parting && value().parting) {
      run = on_cells(input_, *value().parting);
    } else if (figure == &StrikeFigures::peak_force) {
      const auto hit = std::ranges::max_element(result_.sub_impacts, {}, &SubImpact::peak_force);
      if (hit->peak_time > 0.0) run = on_cells(input_, hit->peak_time);
    }
    const Result& until = run ? *run : result_;
    return {until.largest_rotation, until.largest_displacement};
  }

  void add_estimates() {
    const Beam& beam = input_.scene.beam;
    const bool is_held = beam.ends[0] != EndSupport::free && beam.ends[1] != EndSupport::free;
    ModelErrors::Part rotations{"finite rotations", "the square of the largest one", {}};
    ModelErrors::Part stretching{"stretching", "its tension over the buckling load", {}};
    for (const Figure figure : figures) {
      if (!(value().*figure)) continue;
      const auto [rotation, displacement] = deformation_at(figure);
      const double size = std::abs(*(value().*figure));
      rotations.change.*figure = rotation * rotation * size;
      stretching.change.*figure = std::pow(0.5 * displacement / beam.radius_of_gyration(), 2) *
                                  size * (figure == &StrikeFigures::parting ? 0.5 : 1.0);
    }
    errors_.parts.push_back(rotations);
    if (is_held) errors_.parts.push_back(stretching);
    if (!yields(result_)) return;
    const double rotation = largest_magnitude(result_.plastic_zones, &PlasticZone::rotation);
    errors_.parts.push_back({"hinge length", "a hinge as long as the beam is high"});
    errors_.parts.back().change.permanent_set = rotation * beam.height() / 8.0;
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
    errors_.parts.push_back({"thin openings", "openings changed as by the other parts"});
    for (const Figure figure : figures) errors_.parts.back().change.*figure = 0.0;
    errors_.parts.back().change.parting = furthest;
  }

  const Case& input_;
  const Result& result_;
  const Progress& progress_;
  ModelErrors errors_;
  int cells_ = most_cells;  // 0: any are too dear
  bool is_stopped_ = false;
  double change_of_opening_ = 0.0;  // m, of the parting
};

}  // namespace

std::optional<ModelErrors> model_errors(const Case& input, const Result& result,
                                        const Progress& progress) {
  const CaseParts& own = input.parts;
  if (own.mesh || own.contact_law || own.section || own.start || result.sub_impacts.empty() ||
      !descriptor_of(input.model.mesh).bends || !result.outcome.completed()) {
    return std::nullopt;
  }
  return Study(input, result, progress).errors();
}

}  // namespace subimpact
