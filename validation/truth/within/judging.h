#pragma once

/// The study of tolerances: scenes, the truth, and the cheapest setting.

#include <cstdint>
#include <optional>
#include <vector>

#include "strikes.h"
#include "subimpact/case/simulate.h"

namespace subimpact::wishes {

/// A drawn scene without its mesh and method, by seed and number.
Case open_scene(std::uint64_t seed, int number, const strikes::Budget& budget, double work_limit);

/// Event times in the limit of fine meshes, and how far each is known.
struct Reference {
  std::vector<SubImpact> sub_impacts;
  std::vector<double> uncertainty;  ///< s, of the certain ones
};

/// From a mesh so many times as fine, extrapolated with one half as fine. Nothing is
/// known where no such mesh is allowed.
Reference reference_of(const Case& finest, double factor);

/// Leading sub-impacts that the reference gives well enough to judge a tolerance.
std::size_t n_judged(const Reference& reference, double wish);

/// Largest error of the leading `n` sub-impacts; infinite if one is missing.
double error_of(const std::vector<SubImpact>& run, const Reference& reference, std::size_t n);

/// The run of one setting of a sequence.
struct SequenceRun {
  double work = 0.0;  ///< counted
  std::vector<SubImpact> sub_impacts;
};

/// From 1.5 times as fine down, each coarser than the one before by the square root of two, with
/// the accuracy in time that goes with each mesh (Refinement).
std::vector<SequenceRun> sequence_of(const Case& finest, double end_time);

/// Work of the coarsest run that meets the tolerance together with all finer ones; 0 if none does.
double cheapest_work(const std::vector<SequenceRun>& runs, const Reference& reference,
                     std::size_t n, double wish);

double median(std::vector<double> values);

/// Tolerances on event times: is every time before the horizon within the tolerance?
struct WishStudy {
  std::uint64_t seed = 2026;
  int n_scenes = 20;
  strikes::Budget budget;
  double work_limit = 1e8;
  unsigned jobs = 0;   ///< 0: as many as there are cores
  bool trace = false;  ///< every run on stderr
};
int study_wishes(const WishStudy& study);

}  // namespace subimpact::wishes
