// Parts of a caller's own that break a rule: each is refused, or ends its run, with the rule, a
// number and a place; none crashes, none completes, and no message blames the tolerance.

#include "linear_case.h"
#include "subimpact/case/simulate.h"
#include "subimpact/model/mesh/matrix_mesh.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t bars = 20;

Case strike() {
  Case input = linear_case(MeshKind::cells, 51, 0.5, EndSupport::free);
  input.end_time = 0.2e-3;
  return input;
}

// Rigid bars between point masses, with a rotational spring at every mass.
MeshMatrices chain() {
  const Beam beam = strike().scene.beam;
  const double h = beam.length / bars;
  MeshMatrices chain{.mass = {bars + 1, 0}};
  for (std::size_t i = 0; i <= bars; ++i) {
    const bool is_end = i == 0 || i == bars;
    chain.mass.at(i, i) = beam.mass() / bars * (is_end ? 0.5 : 1.0);
    if (is_end) continue;
    chain.curvature.push_back({i - 1, {1.0 / (h * h), -2.0 / (h * h), 1.0 / (h * h)}});
    chain.weights.push_back(h);
    chain.positions.push_back(h * static_cast<double>(i));
  }
  chain.struck_point.terms = {{bars / 2, 1.0}};
  chain.first_end.terms = {{0, 1.0}};
  chain.translation.assign(bars + 1, 1.0);
  return chain;
}

// What a run of broken parts says: the refusal, or the message of an outcome that is not completed.
std::string answer(const std::function<void(Case&)>& break_it) {
  Case input = strike();
  try {
    break_it(input);
    const Result result = simulate(input);
    return result.outcome.completed() ? "completed" : result.outcome.message;
  } catch (const std::exception& error) {
    return error.what();
  }
}

int n_broken = 0;

void expect_named(const std::string& said, const std::string& words, const std::string& what,
                  bool has_number = true) {
  ++n_broken;
  EXPECT_NE(said, "completed") << what;
  EXPECT_NE(said.find(words), std::string::npos) << what << ": " << said;
  EXPECT_EQ(said.find("rtol"), std::string::npos) << what << ": " << said;
  if (!has_number) return;
  EXPECT_NE(said.find_first_of("0123456789"), std::string::npos) << what << ": " << said;
}

void expect_mesh(const std::string& words, const std::function<void(MeshMatrices&)>& break_it) {
  const std::string said = answer([&](Case& input) {
    MeshMatrices matrices = chain();
    break_it(matrices);
    input.parts.mesh = mesh_of(std::move(matrices));
  });
  expect_named(said, words, "a mesh whose fault is: " + words);
}

void break_meshes() {
  using M = MeshMatrices;
  for (const std::size_t unknown : {bars + 1, bars + 2, std::size_t{1'000'000}, SIZE_MAX}) {
    expect_mesh("struck point", [&](M& m) { m.struck_point.terms[0].unknown = unknown; });
    expect_mesh("first end", [&](M& m) { m.first_end.terms[0].unknown = unknown; });
  }
  for (const double coefficient : {nan, infinite, 0.0, 0.5, 2.0}) {
    expect_mesh("struck point", [&](M& m) { m.struck_point.terms[0].coefficient = coefficient; });
    expect_mesh("first end", [&](M& m) { m.first_end.terms[0].coefficient = coefficient; });
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{7}, bars - 2}) {
    for (const double weight : {nan, infinite, 0.0, -0.01}) {
      expect_mesh("the weight of section " + std::to_string(i),
                  [&](M& m) { m.weights[i] = weight; });
    }
    for (const double x : {nan, infinite, -0.1, 1.5}) {
      expect_mesh("section " + std::to_string(i) + " lies at", [&](M& m) { m.positions[i] = x; });
    }
    for (const double mass : {nan, 0.0, -1.0}) {
      expect_mesh("mass", [&](M& m) { m.mass.at(i, i) = mass; });
    }
    expect_mesh("mass", [&](M& m) { m.mass.at(i, i) = infinite; });
    const std::string row = "section " + std::to_string(i);
    expect_mesh("curvature of " + row, [&](M& m) { m.curvature[i].coefficients[1] = nan; });
    expect_mesh("curvature of " + row, [&](M& m) { m.curvature[i].coefficients.clear(); });
    expect_mesh("curvature of " + row, [&](M& m) { m.curvature[i].first = bars; });
    expect_mesh("bends its " + row, [&](M& m) { m.curvature[i].coefficients[2] *= 1.1; });
  }
  for (const double factor : {0.5, 0.9, 2.0, 1e3}) {
    expect_mesh("its mass is", [&](M& m) {
      for (std::size_t i = 0; i <= bars; ++i) m.mass.at(i, i) *= factor;
    });
  }
  for (const double factor : {0.4, 2.0, 1e3}) {
    expect_mesh("weights of its sections add up", [&](M& m) {
      for (double& weight : m.weights) weight *= factor;
    });
  }
  for (const double moved : {0.5, 2.0}) {
    expect_mesh("", [&](M& m) { m.translation[bars / 2] = moved; });
  }
  expect_mesh("18 weights", [](M& m) { m.weights.pop_back(); });
  expect_mesh("18 positions", [](M& m) { m.positions.pop_back(); });
  expect_mesh("a translation of 20", [](M& m) { m.translation.pop_back(); });
  expect_mesh("a translation of 22", [](M& m) { m.translation.push_back(1.0); });
  expect_mesh("21 unknowns is not", [](M& m) { m.mass = BandedMatrix(bars + 1, 1); });
  expect_mesh("half bandwidth of 4", [](M& m) { m.mass = BandedMatrix(bars + 1, 4); });
}

// A good mesh but for one function.
class Faulty final : public BeamMesh {
 public:
  enum class Fault { curvatures, forces, slow, not_a_number, struck_section, none };
  explicit Faulty(Fault fault)
      : BeamMesh(bars + 1, 0, false), good_(mesh_of(chain())), fault_(fault) {
    mass_ = good_->mass();
    weights_.assign(good_->section_weights().begin(), good_->section_weights().end());
    positions_.assign(good_->section_positions().begin(), good_->section_positions().end());
    struck_point_ = good_->struck_point();
    first_end_ = good_->first_end();
    struck_section_ = fault == Fault::struck_section ? 99 : good_->struck_section();
    translation_.assign(bars + 1, 1.0);
    momentum_functional_.assign(good_->momentum_functional().begin(),
                                good_->momentum_functional().end());
    beam_mass_ = good_->beam_mass();
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      add_stencil(good_->section_stencil(i).first, good_->section_stencil(i).coefficients);
    }
  }
  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override {
    good_->curvatures(unknowns, kappa);
    if (fault_ == Fault::curvatures) kappa[3] *= 1.001;
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    good_->bending_forces(moments, forces);
    if (fault_ == Fault::forces) forces[5] = -forces[5];
  }
  double highest_frequency(double stiffness) const override {
    const double highest = good_->highest_frequency(stiffness);
    return fault_ == Fault::slow ? 0.5 * highest : fault_ == Fault::not_a_number ? nan : highest;
  }
  std::string description() const override { return "a faulty chain"; }

 private:
  std::shared_ptr<const BeamMesh> good_;
  Fault fault_;
};

// A linear law but for what is overridden by functions.
struct FaultyLaw final : ContactLaw {
  std::function<double(ContactHistory, double)> f = [](auto, double x) { return 2e6 * x; };
  std::function<double(ContactHistory)> residual, threshold;
  std::function<double(double)> steepness, energy;
  std::string name() const override { return "faulty"; }
  double force(ContactHistory history, double x) const override { return f(history, x); }
  double residual_indentation(ContactHistory history) const override {
    return residual ? residual(history) : 0.0;
  }
  double yield_threshold(ContactHistory history) const override {
    return threshold ? threshold(history) : infinite;
  }
  double slope(ContactHistory history, double x) const override {
    return steepness ? steepness(x) : ContactLaw::slope(history, x);
  }
  double recoverable_energy(ContactHistory history, double x) const override {
    return energy ? energy(x) : ContactLaw::recoverable_energy(history, x);
  }
};

void expect_law(const std::string& words, const std::function<void(FaultyLaw&)>& break_it) {
  const std::string said = answer([&](Case& input) {
    auto law = std::make_shared<FaultyLaw>();
    break_it(*law);
    input.parts.contact_law = law;
  });
  expect_named(said, words, "a law whose fault is: " + words);
}

void break_laws() {
  constexpr double k = 2e6;
  for (const double factor : {-1.0, 0.0, nan, infinite}) {
    expect_law(factor < 0.0 ? "contact pushes" : "its force at an indentation",
               [&](FaultyLaw& law) { law.f = [=](auto, double x) { return factor * k * x; }; });
  }
  for (const double at : {1e-4, 3e-4, 1e-3}) {
    for (const double jump : {0.02, 0.3}) {
      expect_law("force jumps from", [&](FaultyLaw& law) {
        law.f = [=](auto, double x) { return k * x + (x > at ? jump * k * 2e-3 : 0.0); };
      });
    }
    expect_law("pu", [&](FaultyLaw& law) {  // "contact pushes", or "would pull" where it is weak
      law.f = [=](auto, double x) { return k * x * (x - at) * (x - 2.0 * at) / (at * at); };
    });
  }
  expect_law("jumps", [](FaultyLaw& law) { law.f = [](auto, double x) { return k * x + 50.0; }; });
  expect_law("residual indentation", [](FaultyLaw& law) {
    law.residual = [](ContactHistory history) { return 2.0 * history.max_indentation; };
    law.threshold = [](ContactHistory history) { return history.max_indentation; };
  });
  expect_law("residual indentation",
             [](FaultyLaw& law) { law.residual = [](auto) { return -1e-6; }; });
  expect_law("threshold falls", [](FaultyLaw& law) {
    law.threshold = [](ContactHistory history) { return 1e-2 - history.max_indentation; };
  });
  expect_law("its energies grow",
             [](FaultyLaw& law) { law.energy = [](double x) { return k * x * x; }; });
  expect_law("the integral of its slope",
             [](FaultyLaw& law) { law.steepness = [](double) { return 2.0 * k; }; });
}

// Euler's steps, wrong as the fault says.
struct FaultyIntegrator final : Integrator {
  enum class Fault { backwards, not_a_number, gives_up };
  FaultyIntegrator(SecondOrderOde& given, double step, Fault what)
      : ode(given), h(step), fault(what), a(given.n_positions()) {}
  void restart(double t, const State& y) override { stand_at(t, y); }
  void step() override {
    t0_ = t1_;
    y0_ = y1_;
    if (fault == Fault::gives_up) throw IntegrationFailure(t0_, "own()", "TOO_HARD", "at 1 us");
    advance(h, y1_);
    t1_ = t0_ + h;
  }
  void state_at(double t, State& y) override { advance(t - t0_, y); }
  void advance(double by, State& y) {
    const std::size_t n = a.size();
    ode.acceleration({y0_.data(), n}, a);
    y = y0_;
    const double sign = fault == Fault::backwards ? -1.0 : 1.0;
    for (std::size_t i = 0; i < n; ++i) y[i] += by * y0_[n + i];
    for (std::size_t i = 0; i < n; ++i) y[n + i] += sign * by * a[i];
    if (fault == Fault::not_a_number) y[0] = nan;
  }
  SecondOrderOde& ode;
  double h;
  Fault fault;
  std::vector<double> a;
};

void break_integrators() {
  const auto with = [](OwnIntegrator own, std::optional<double> step) {
    return answer([&](Case& input) {
      input.solver.method = Method::own;
      input.solver.step = step;
      if (own.order >= 0) input.parts.integrator = std::make_shared<OwnIntegrator>(own);
    });
  };
  const auto none = [](SecondOrderOde&, const StepControl&) { return nullptr; };
  expect_named(with({.make = none, .order = -1}, 1e-7), "no integrator is given", "none", false);
  expect_named(with({.make = {}}, 1e-7), "no integrator is given", "no maker", false);
  expect_named(with({.make = none}, 1e-7), "make() returned none", "returns none", false);
  expect_named(with({.make = none}, {}), "solver.step is missing", "no step");
  using Fault = FaultyIntegrator::Fault;
  for (const auto& [fault, words] :
       {std::pair(Fault::backwards, "check the integrator of your own"),
        {Fault::not_a_number, "no longer finite"},
        {Fault::gives_up, "own() failed with TOO_HARD"}}) {
    const auto make = [fault](SecondOrderOde& ode, const StepControl& control) {
      return std::make_unique<FaultyIntegrator>(ode, *control.step, fault);
    };
    expect_named(with({.make = make}, 1e-7), words,
                 "an integrator, fault " + std::to_string(int(fault)), fault == Fault::gives_up);
  }
}

TEST(AHundredBrokenParts, AreNamedByRuleNumberAndPlaceAndNoneCompletesOrBlamesTheTolerance) {
  n_broken = 0;
  break_meshes();
  for (const auto& [fault, words] : {std::pair(Faulty::Fault::curvatures, "curvatures() gives"),
                                     {Faulty::Fault::forces, "bending_forces() gives"},
                                     {Faulty::Fault::slow, "its highest frequency is"},
                                     {Faulty::Fault::not_a_number, "its highest frequency is"},
                                     {Faulty::Fault::struck_section, "its struck section is 99"}}) {
    expect_named(answer([&](Case& input) { input.parts.mesh = std::make_shared<Faulty>(fault); }),
                 words, words);
  }
  break_laws();
  break_integrators();
  EXPECT_GE(n_broken, 100);
}

TEST(AHundredBrokenParts, AreGoodWithoutTheirFaults) {
  const auto good = [](Case& input) {
    input.parts.mesh = std::make_shared<Faulty>(Faulty::Fault::none);
    input.parts.contact_law = std::make_shared<FaultyLaw>();
  };
  EXPECT_EQ(answer(good), "completed");
  EXPECT_EQ(answer([](Case& input) { input.parts.mesh = mesh_of(chain()); }), "completed");
}

TEST(ARefusedCase, NamesItsKeyInItsMessage) {
  Case input = strike();
  input.solver.rtol = -1.0;
  EXPECT_TRUE(message_of<InvalidCase>([&] { simulate(input); }).starts_with("solver.rtol is "));
}

}  // namespace
}  // namespace subimpact
