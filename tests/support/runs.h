#pragma once

#include <string>

#include "refusal.h"
#include "subimpact/case/simulate.h"
#include "testing.h"

namespace subimpact {

/// A run of which the test expects that it reaches its end time.
inline Result completed(const Case& input) {
  Result result = simulate(input);
  EXPECT_TRUE(result.outcome.completed()) << result.outcome.message;
  return result;
}

/// An elastic beam in its own unknowns where it would run in natural modes: it might yield, but at
/// a stress that it does not reach. The law of the contact has to have its own constants.
inline Case at_nodes(Case input) {
  input.model.section = SectionKind::exact;
  input.scene.beam.yield_stress = 1e15;
  return input;
}

inline double start_us(const SubImpact& s) { return 1e6 * s.start; }
inline double end_us(const SubImpact& s) { return 1e6 * s.end.value_or(-1.0); }

/// As many sub-impacts, starting at the same times within a tolerance in us.
inline void expect_same_starts(const Result& a, const Result& b, double tolerance_us) {
  ASSERT_EQ(a.sub_impacts.size(), b.sub_impacts.size());
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    EXPECT_NEAR(start_us(a.sub_impacts[i]), start_us(b.sub_impacts[i]), tolerance_us) << i;
  }
}

/// The same of their ends, which either both or neither has.
inline void expect_same_ends(const Result& a, const Result& b, double tolerance_us) {
  ASSERT_EQ(a.sub_impacts.size(), b.sub_impacts.size());
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    EXPECT_EQ(a.sub_impacts[i].end.has_value(), b.sub_impacts[i].end.has_value()) << i;
    EXPECT_NEAR(end_us(a.sub_impacts[i]), end_us(b.sub_impacts[i]), tolerance_us) << i;
  }
}

inline Refusal refusal_of(const Case& input) {
  return refusal_of([&] { resolve(input); });
}

/// A case is refused for a key; each of these words stands in the message.
template <class... Words>
void expect_refused(const Case& input, const std::string& key, const Words&... words) {
  const auto [found, message] = refusal_of(input);
  EXPECT_EQ(found, key) << message;
  expect_in(message, words...);
}

}  // namespace subimpact
