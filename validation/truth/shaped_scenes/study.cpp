// Random scenes over shapes of sections, contact laws, noses and hardening: does each run conserve
// energy, do two methods agree, and do cells and elements agree within their errors?
// scripts/study shaped_scenes.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "draws.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

constexpr std::array shapes{SectionShape::rectangle, SectionShape::circle, SectionShape::tube,
                            SectionShape::box, SectionShape::i};
constexpr std::array shape_names{"rectangle", "circle", "tube", "box", "i"};
constexpr std::array laws{ContactKind::foundation, ContactKind::hertz, ContactKind::linear,
                          ContactKind::sphere};
constexpr std::array law_names{"foundation", "hertz", "linear", "sphere"};

void draw_section(Random& random, double height, CrossSection& section) {
  section = {};
  section.shape = random.one_of(shapes);
  const double width = height * random.log_uniform(0.4, 3.0);
  const double wall = std::min(height, width) * random.uniform(0.05, 0.3);
  switch (section.shape) {
    case SectionShape::circle:
      section.diameter = height;
      return;
    case SectionShape::tube:
      section.diameter = height;
      section.wall = 0.5 * height * random.uniform(0.1, 0.7);
      return;
    case SectionShape::box:
      section.wall = wall;
      break;
    case SectionShape::i:
      section.flange = wall;
      section.web = wall * random.uniform(0.5, 1.0);
      break;
    case SectionShape::rectangle:
      break;
  }
  section.height = height;
  section.width = width;
}

// A metal beam, struck so hard that most yield.
Case draw(Random& random) {
  Case input;
  Beam& beam = input.scene.beam;
  beam.length = random.log_uniform(0.2, 1.5);
  beam.density = random.uniform(2500.0, 8000.0);
  beam.youngs_modulus = random.uniform(6e10, 2.2e11);
  beam.yield_stress = beam.youngs_modulus * random.log_uniform(5e-4, 5e-3);
  beam.hardening = random.chance(0.5) ? random.log_uniform(1e-3, 0.3) : 0.0;
  beam.theory = random.chance(0.3) ? BeamTheory::timoshenko : BeamTheory::rayleigh;
  beam.poisson = random.uniform(0.25, 0.35);
  constexpr std::array ends{EndSupport::free, EndSupport::pinned, EndSupport::clamped};
  beam.ends = {random.one_of(ends), random.one_of(ends)};
  draw_section(random, beam.length * random.log_uniform(1.0 / 80.0, 1.0 / 15.0), beam.section);
  Striker& striker = input.scene.striker;
  striker.mass = beam.mass() * random.log_uniform(0.1, 3.0);
  striker.nose_radius = beam.height() * random.log_uniform(0.5, 4.0);
  if (random.chance(0.5)) {
    striker.nose = random.chance(0.5) ? NoseShape::sphere : NoseShape::cylinder;
  }
  striker.velocity = random.log_uniform(0.3, 20.0);
  striker.position = random.chance(0.4) ? 0.5 : random.uniform(0.25, 0.75);
  Contact& contact = input.scene.contact;
  contact.kind = random.one_of(laws);
  if (contact.kind == ContactKind::linear) {
    contact.stiffness = beam.youngs_modulus * beam.height() * random.log_uniform(0.01, 0.3);
  } else if (contact.kind != ContactKind::foundation) {
    contact.striker_modulus = random.uniform(6e10, 2.2e11);
    contact.striker_poisson = 0.3;
  }
  constexpr std::array kinds{SectionKind::elastic, SectionKind::layers, SectionKind::exact,
                             SectionKind::exact};
  input.model.section = random.one_of(kinds);
  input.model.layers = 2 * (5 + static_cast<int>(random.index(16)));
  input.model.segments = 81;
  input.end_time = 2.5e-3 * beam.length;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-9;
  input.output.keep_no_rows();
  return input;
}

Result judged(const Case& input) { return simulate_judged(input, cases_beside(input), 1); }

struct Count {
  int good = 0, all = 0;
  void add(bool is_good) {
    good += is_good ? 1 : 0;
    ++all;
  }
};

// Times of the sub-impacts that both call certain.
Count within_errors(const Result& one, const Result& other) {
  Count count;
  for (const MatchedPair& pair : match_sub_impacts(one.sub_impacts, other.sub_impacts)) {
    if (!pair.first || !pair.second) continue;
    const SubImpact& a = one.sub_impacts[*pair.first];
    const SubImpact& b = other.sub_impacts[*pair.second];
    if (!a.certain.value_or(false) || !b.certain.value_or(false) || !a.end || !b.end) continue;
    if (!a.end_error || !b.end_error) continue;
    count.add(std::abs(*a.end - *b.end) <= *a.end_error + *b.end_error);
  }
  return count;
}

// The same count, or a sub-impact that is marked uncertain.
bool agrees_or_is_marked(const Result& one, const Result& other) {
  if (one.sub_impacts.size() == other.sub_impacts.size()) return true;
  return std::ranges::any_of(one.sub_impacts,
                             [](const SubImpact& s) { return !s.certain.value_or(false); });
}

struct Tally {
  Count runs, methods, elements;
  int yielded = 0, certain = 0, contacts = 0;
};

void print_row(const char* name, const Tally& t) {
  const auto part = [](const Count& c) {
    return c.all > 0 ? fmt::format("{} of {}", c.good, c.all) : std::string("-");
  };
  fmt::print("| {} | {} | {} | {} of {} | {} | {} |\n", name, part(t.runs), t.yielded, t.certain,
             t.contacts, part(t.methods), part(t.elements));
}

int study(int n_scenes, std::uint64_t seed) {
  Random random(seed);
  Tally all;
  std::map<std::string, Tally> by;
  int drawn = 0;
  while (all.runs.all < n_scenes) {
    const Case input = draw(random);
    ++drawn;
    try {
      check(input);
    } catch (const InvalidCase&) {  // a nose or section that the law does not describe
      continue;
    }
    const Result cells = judged(input);
    std::vector<Tally*> rows{
        &all, &by[shape_names[static_cast<std::size_t>(input.scene.beam.section.shape)]],
        &by[law_names[static_cast<std::size_t>(input.scene.contact.kind)]]};
    if (input.scene.beam.hardening > 0.0) rows.push_back(&by["hardening"]);
    const auto for_each = [&](auto change) {
      for (Tally* row : rows) change(*row);
    };
    const bool completed = cells.outcome.completed();
    if (!completed) {
      fmt::print(stderr, "scene {}: {}\n", drawn, cells.outcome.message);
    }
    for_each([&](Tally& t) {
      t.runs.add(completed);
      t.yielded += cells.n_yielded_sections > 0 ? 1 : 0;
      t.contacts += static_cast<int>(cells.sub_impacts.size());
      for (const SubImpact& s : cells.sub_impacts) t.certain += s.certain.value_or(false) ? 1 : 0;
    });
    Case other = input;
    other.solver.method = Method::erk;
    const bool agrees = agrees_or_is_marked(cells, simulate(other));
    if (!agrees) fmt::print(stderr, "scene {}: counts differ by method, all certain\n", drawn);
    for_each([&](Tally& t) { t.methods.add(agrees); });
    Case meshed = input;
    meshed.model.mesh = MeshKind::hermite;
    meshed.model.elements = 60;
    try {
      const Count found = within_errors(cells, judged(meshed));
      for_each([&](Tally& t) {
        t.elements.good += found.good;
        t.elements.all += found.all;
      });
    } catch (const InvalidCase&) {  // a theory or section that the mesh does not carry
    }
  }
  fmt::print(
      "{} scenes of {} drawn; in the others the law does not describe nose and section\n\n"
      "| scenes | completed, energy closed | yielded | certain contacts | counts of erk agree, or "
      "are marked | times: elements |\n|---|---|---|---|---|---|\n",
      all.runs.all, drawn);
  for (const auto& [name, tally] : by) print_row(name.c_str(), tally);
  print_row("all", all);
  return all.runs.good == all.runs.all ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace subimpact

int main(int argc, char** argv) {
  const int n_scenes = argc > 1 ? std::atoi(argv[1]) : 200;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 36);
  return subimpact::study(n_scenes, seed);
}
