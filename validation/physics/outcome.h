#pragma once

/// What a validation case finds: published numbers beside the program's own.

#include <string>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact::validation {

enum class Bound {
  relative,  ///< |ours/published - 1| <= tolerance
  absolute,  ///< |ours - published| <= tolerance
  within,    ///< tolerance holds for ours < published (an upper bound)
  holds      ///< a statement: 1 if it holds here
};

/// One published quantity. The tolerance is written down before the comparison is made.
struct Row {
  std::string quantity;
  double published;
  double ours;
  Bound bound;
  double tolerance;
  /// Where ours is known to differ: why. A row that differs without a reason fails.
  std::string why_it_differs = {};

  bool agrees() const;
  bool fails() const { return !agrees() && why_it_differs.empty(); }
  /// -log10 of the relative difference, at most 12; of statements and bounds none (negative).
  double digits() const;
};

struct Outcome {
  std::string source;  ///< a few words: "Timoshenko 1913"
  std::vector<Row> rows;
  std::vector<std::string> notes;  ///< Markdown, printed below the table: studies, mesh limits
};

/// The case file of a validation folder, with settings in place of its own.
Case case_of(const std::string& folder, const std::vector<std::string>& settings = {});

/// Rows as a Markdown table. `name` adds a first column with the case's name and its source.
std::string table(const Outcome& outcome, const std::string& name = {});
std::string table_head(bool with_name);

// The cases, by folder.
Outcome check_bending();
Outcome check_conservation();
Outcome check_contact();
Outcome check_contact_tests();
Outcome check_damped_contact();
Outcome check_frequencies();
Outcome check_glued_mass();
Outcome check_long_beam();
Outcome check_paper();
Outcome check_paper_as_computed();
Outcome check_repeated_strikes();
Outcome check_rigid_bodies();
Outcome check_rigid_plastic();
Outcome check_scenes();
Outcome check_sdnl32();
Outcome check_shear();
Outcome check_spectral_identity();
Outcome check_timoshenko();

}  // namespace subimpact::validation
