#pragma once

/// Comparison of a measured force with the computed one.

#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// The signal of a transducer with a Butterworth low-pass of fourth order, for a force that is zero
/// before the first sample:
///
///     H(s) = product over k = 0..3 of -p_k / (s - p_k),  p_k = 2 pi f exp(i pi (5 + 2 k)/8),
/// with `cutoff` f in Hz, where the loss is 3 dB. At the samples the result is exact for the
/// piecewise linear force, however far apart they are; low frequencies are delayed by 2.61/(2 pi
/// f), which is 21 us at 20 kHz.
Signal low_passed(const Signal& force, double cutoff);

struct OverlayOptions {
  std::optional<double> shift;     ///< s; none: it is found
  std::optional<double> low_pass;  ///< Hz; none: no filter, or it is found
  bool find_low_pass = false;
};

/// A fitted number with its standard error, where the difference of the two forces counts as white
/// noise; a given number has no error.
struct Fitted {
  double value = 0.0;
  std::optional<double> error;
};

/// The computed force of a run and a measured one on one time axis, that of the run.
struct Overlay {
  Fitted shift;                    ///< s, by which the measured time is later than that of the run
  std::optional<Fitted> low_pass;  ///< Hz
  /// How alike the two forces are at the measured samples within [from, to]: sum of products over
  /// the root of both sums of squares; 1 if they differ only by a factor.
  double correlation = 0.0;
  double sampling_interval = 0.0;  ///< s, the median
  double from = 0.0, to = 0.0;     ///< s, time that run and measurement both cover
  struct Side {
    Signal force;            ///< the computed one as filtered
    double peak = 0.0;       ///< N, the largest within [from, to]
    double peak_time = 0.0;  ///< s
    double impulse = 0.0;    ///< N s, within [from, to]
  };
  Side computed, measured;
  Signal difference;  ///< computed minus measured, at the measured samples within [from, to]
  /// Whether the found cut-off is at an end of the searched range: the measurement shows no filter.
  bool low_pass_at_bound = false;
};

/// Compares a measured force with the history of a run, whose force is zero before it begins. Shift
/// and cut-off are those with the largest correlation; the cut-off lies between two periods within
/// the measured record and its Nyquist frequency. Throws ResultsError if there is no common time,
/// the run has no history or one of the forces is nowhere positive.
Overlay overlay_of(const std::vector<HistoryRow>& history, const Signal& measured,
                   const OverlayOptions& options = {});

}  // namespace subimpact
