// Supports that only push: closed forms of rigid bars, symmetry, methods, balances, refusals.

#include <Eigen/Core>

#include "numerics/bracketed_root.h"
#include "paper_case.h"
#include "settings.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

constexpr double k_contact = 2e6, k_support = 3e6;

Case bar_case() {
  Case input = paper_run(SectionKind::elastic, 0.0, 501, Method::nystrom);
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = k_contact;
  input.scene.striker.nose_radius.reset();
  input.model.mesh = MeshKind::rigid;
  input.solver.rtol = 1e-13;
  return input;
}

Spring support(double position, double gap = 0.0, double stiffness = k_support) {
  return {position, stiffness, OneSided{gap}};
}

struct Spell {
  int contact;  // 0: the striker's
  double start, end;
};

// A rigid bar on springs that only push, struck by a mass: linear while the same contacts are
// closed, so that states follow by the exponential of a matrix.
class RigidBar {
 public:
  explicit RigidBar(const Case& input) : input_(input) {
    const Beam& beam = input.scene.beam;
    inertias_ << beam.mass(),
        beam.mass() * beam.length * beam.length / 12.0 + beam.rotary_inertia() * beam.length,
        input.scene.striker.mass;
    const double arm = (input.scene.striker.position - 0.5) * beam.length;
    contacts_.push_back({{-1.0, -arm, 1.0}, *input.scene.contact.stiffness, 0.0});
    for (const Spring& spring : beam.springs) {
      contacts_.push_back({{1.0, (spring.position - 0.5) * beam.length, 0.0},
                           spring.stiffness,
                           spring.one_sided->gap});
    }
  }

  std::vector<Spell> spells(double end) {
    State y = State::Zero();
    y[5] = input_.scene.striker.velocity;
    y[6] = 1.0;
    std::vector<bool> closed(contacts_.size(), false);
    std::vector<Spell> all, open(contacts_.size());
    double t = 0.0;
    const auto toggle = [&](std::size_t i) {
      if (closed[i]) all.push_back({static_cast<int>(i), open[i].start, t});
      open[i].start = t;
      closed[i] = !closed[i];
    };
    toggle(0);
    for (std::size_t i = 1; i < contacts_.size(); ++i) {  // by the first motion, as t^3
      const double first = contacts_[i].at.dot(-contacts_[0].at.cwiseQuotient(inertias_));
      if (contacts_[i].gap == 0.0 && first > 0.0) toggle(i);
    }
    constexpr double step = 1e-6, least = 1e-17;
    while (t < end) {
      const Matrix rate = rate_of(closed);
      const State next = after(step, rate, y);
      std::optional<std::size_t> found;
      double when = step;
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const double sign = closed[i] ? -1.0 : 1.0;
        if (!(sign * depth(i, next) > least)) continue;
        const double at = root_in([&](double h) { return depth(i, after(h, rate, y)); },
                                  t == open[i].start ? 1e-3 * step : 0.0, step);
        if (at < when) {
          when = at;
          found = i;
        }
      }
      y = after(when, rate, y);
      t += when;
      if (found) toggle(*found);
    }
    return all;
  }

 private:
  using Vector = Eigen::Vector3d;
  using State = Eigen::Matrix<double, 7, 1>;  // q, v, 1
  using Matrix = Eigen::Matrix<double, 7, 7>;
  struct Contact {
    Vector at;
    double stiffness, gap;
  };

  // y after h seconds, by the series of the exponential: steps are short.
  static State after(double h, const Matrix& rate, const State& y) {
    State sum = y, term = y;
    for (int k = 1; k < 24; ++k) sum += term = State(rate * term) * h / k;
    return sum;
  }
  double depth(std::size_t i, const State& y) const {
    return contacts_[i].at.dot(y.head<3>()) - contacts_[i].gap;
  }
  Matrix rate_of(const std::vector<bool>& closed) const {
    Matrix rate = Matrix::Zero();
    rate.block<3, 3>(0, 3).setIdentity();
    const double g = input_.scene.gravity;
    rate(3, 6) = rate(5, 6) = g;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (!closed[i]) continue;
      const Contact& c = contacts_[i];
      const Vector push = -c.stiffness * c.at.cwiseQuotient(inertias_);
      rate.block<3, 3>(3, 0) += push * c.at.transpose();
      rate.block<3, 1>(3, 6) -= push * c.gap;
    }
    return rate;
  }

  const Case& input_;
  Vector inertias_;
  std::vector<Contact> contacts_;
};

std::vector<Spell> spells_of(const Result& result) {
  std::vector<Spell> all;
  for (const SubImpact& s : result.sub_impacts) {
    if (s.end) all.push_back({0, s.start, *s.end});
  }
  for (const SupportContact& c : result.support_contacts) {
    if (c.end) all.push_back({static_cast<int>(c.spring) + 1, c.start, *c.end});
  }
  std::ranges::sort(all, {}, [](const Spell& s) { return std::tuple(s.start, s.contact, s.end); });
  return all;
}

void expect_same(const Result& result, std::vector<Spell> expected, double tolerance) {
  std::ranges::sort(expected, {}, [](const Spell& s) { return std::tuple(s.start, s.contact); });
  const std::vector<Spell> found = spells_of(result);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].contact, expected[i].contact) << i;
    EXPECT_NEAR(found[i].start, expected[i].start, tolerance) << i;
    EXPECT_NEAR(found[i].end, expected[i].end, tolerance) << i;
  }
}

class ABarByAMethod : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(, ABarByAMethod,
                         testing::Values(Method::erk, Method::nystrom, Method::dirk, Method::adams,
                                         Method::bdf),
                         NamedAsPrinted{});

TEST_P(ABarByAMethod, LiftsOffOneOrTwoSpringsWhenItsClosedFormDoes) {
  for (const EventHandling events : {EventHandling::located, EventHandling::library}) {
    if (events == EventHandling::library && GetParam() == Method::nystrom) continue;
    for (const double struck : {0.5, 0.6, 1.0}) {
      for (const bool two : {true, false}) {
        SCOPED_TRACE(fmt::format("{} {} {}", struck, two, static_cast<int>(events)));
        Case input = bar_case();
        input.solver.method = GetParam();
        input.solver.rtol = GetParam() == Method::dirk ? 1e-11 : 1e-13;
        input.solver.events = events;
        input.scene.striker.position = struck;
        input.scene.beam.springs = {support(1.0)};
        if (two) input.scene.beam.springs.push_back(support(0.0));
        input.end_time = 4e-3;
        const Result result = completed(input);
        const double period = 2.0 * M_PI * std::sqrt(input.scene.striker.mass / k_contact);
        expect_same(result, RigidBar(input).spells(input.end_time), 1e-9 * period);
        EXPECT_LT(result.max_energy_error, 1e-8);
        EXPECT_LT(result.max_momentum_error.value(), 1e-8);
      }
    }
  }
}

TEST(ABarThatRests, SharesItsWeightAndALoadAmongItsSupports) {
  Case input = bar_case();
  Beam& beam = input.scene.beam;
  beam.rests = {true, true};
  beam.forces = {{0.3, {{0.0, 50.0}}}};
  input.scene.gravity = 9.81;
  input.output.interval = 1e-6;
  input.end_time = 1e-5;
  for (const MeshKind mesh : {MeshKind::rigid, MeshKind::hermite, MeshKind::cells}) {
    input.model.mesh = mesh;
    const Result result = completed(input);
    const double weight = beam.mass() * 9.81;
    EXPECT_NEAR(result.history.front().first_reaction.value(), -(0.5 * weight + 0.7 * 50.0), 1e-7);
    EXPECT_NEAR(result.history.front().last_reaction.value(), -(0.5 * weight + 0.3 * 50.0), 1e-7);
  }
}

Case elastic_bar() {
  Case input = bar_case();
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 20;
  input.scene.beam.springs = {support(0.0, 0.0, 2e7), support(1.0, 0.0, 2e7),
                              support(0.5, 2e-4, 5e6)};
  input.solver.rtol = 1e-11;
  input.end_time = 1.5e-3;
  return input;
}

TEST(ADampedSupport, TakesTheEnergyThatTheRunAccountsFor) {
  Case input = elastic_bar();
  for (Spring& spring : input.scene.beam.springs) spring.one_sided->damping = 0.3;
  input.solver.method = Method::erk;
  const Result result = completed(input);
  EXPECT_GT(result.beam_damping_loss, 1e-3 * result.used.initial_energy);
  EXPECT_LT(result.max_energy_error, 1e-6);
}

TEST(ABeamOnSupports, ThatTipsUnderItsWeightIsRefused) {
  Case input = elastic_bar();
  input.scene.beam.springs = {support(0.0), support(0.2)};
  input.scene.beam.start = BeamStart::equilibrium;
  input.scene.gravity = 9.81;
  for (const MeshKind mesh : {MeshKind::rigid, MeshKind::hermite}) {
    input.model.mesh = mesh;
    expect_refused(input, "beam.start", "tips or lifts off the supports");
  }
}

TEST(ABeamOnSupports, LiesOnThoseThatItTouchesWhateverGapsTheOthersHave) {
  Case input = elastic_bar();
  Spring before = support(0.811, 1e-4);
  before.one_sided->side = SpringSide::before;
  input.scene.beam.springs = {before, support(1.0), support(0.131), support(0.332, 1e-3)};
  input.scene.beam.start = BeamStart::equilibrium;
  input.scene.gravity = 9.81;
  for (const MeshKind mesh : {MeshKind::rigid, MeshKind::hermite}) {
    input.model.mesh = mesh;
    EXPECT_NO_THROW(completed(input));
  }
}

TEST(ABeamOnSupports, ThatCannotBeIsRefusedWithItsReason) {
  const KeyValue rests = Names{"rests", "rests"};
  const std::tuple<const char*, const char*, Settings> refused[] = {
      {"beam.ends", "no load presses", {{"beam.ends", rests}}},
      {"beam.start",
       "nothing holds",
       {{"beam.ends", Names{"rests", "free"}}, {"scene.gravity", 9.81}}},
      {"solver.method",
       "natural modes",
       {{"beam.ends", rests}, {"scene.gravity", 9.81}, {"solver.method", "exponential"}}},
      {"beam.damping.ratio",
       "natural modes",
       {{"beam.ends", rests},
        {"scene.gravity", 9.81},
        {"beam.damping.ratio", 0.01},
        {"solver.method", "erk"}}},
  };
  for (const auto& [key, words, settings] : refused) {
    SCOPED_TRACE(words);
    Case input = elastic_bar();
    input.scene.beam.springs.clear();
    input.end_time = 1e-3;
    expect_refused(changed(input, settings), key, words);
  }
}

}  // namespace
}  // namespace subimpact
