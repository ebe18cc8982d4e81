#pragma once

#include "subimpact/simulate/result.h"
#include "testing.h"

namespace subimpact {

/// Two results are the same, bit for bit.
inline void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.outcome.kind, b.outcome.kind);
  EXPECT_EQ(a.outcome.message, b.outcome.message);
  EXPECT_EQ(a.outcome.time, b.outcome.time);
  ASSERT_EQ(a.transitions.size(), b.transitions.size());
  for (std::size_t i = 0; i < a.transitions.size(); ++i) {
    EXPECT_EQ(a.transitions[i].kind, b.transitions[i].kind) << i;
    EXPECT_EQ(a.transitions[i].time, b.transitions[i].time) << i;
    EXPECT_EQ(a.transitions[i].value, b.transitions[i].value) << i;
  }
  ASSERT_EQ(a.sub_impacts.size(), b.sub_impacts.size());
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    EXPECT_EQ(a.sub_impacts[i].start, b.sub_impacts[i].start) << i;
    EXPECT_EQ(a.sub_impacts[i].end, b.sub_impacts[i].end) << i;
    EXPECT_EQ(a.sub_impacts[i].peak_force, b.sub_impacts[i].peak_force) << i;
    EXPECT_EQ(a.sub_impacts[i].impulse, b.sub_impacts[i].impulse) << i;
    EXPECT_EQ(a.sub_impacts[i].force_integral, b.sub_impacts[i].force_integral) << i;
    EXPECT_EQ(a.sub_impacts[i].striker_velocity, b.sub_impacts[i].striker_velocity) << i;
    EXPECT_EQ(a.sub_impacts[i].residual_indentation, b.sub_impacts[i].residual_indentation) << i;
  }
  ASSERT_EQ(a.history.size(), b.history.size());
  for (std::size_t i = 0; i < a.history.size(); ++i) {
    EXPECT_EQ(a.history[i].time, b.history[i].time) << i;
    EXPECT_EQ(a.history[i].force, b.history[i].force) << i;
    EXPECT_EQ(a.history[i].back_stress, b.history[i].back_stress) << i;
    EXPECT_EQ(a.history[i].energy_error, b.history[i].energy_error) << i;
  }
  EXPECT_EQ(a.first_section_yield, b.first_section_yield);
  EXPECT_EQ(a.first_contact_yield, b.first_contact_yield);
  EXPECT_EQ(a.n_yielded_sections, b.n_yielded_sections);
  EXPECT_EQ(a.striker_velocity, b.striker_velocity);
  EXPECT_EQ(a.max_energy_error, b.max_energy_error);
  EXPECT_EQ(a.work.steps, b.work.steps);
  EXPECT_EQ(a.work.right_hand_sides, b.work.right_hand_sides);
}

}  // namespace subimpact
