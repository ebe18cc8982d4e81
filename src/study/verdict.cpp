#include "subimpact/study/verdict.h"

namespace subimpact {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "right";
    case Verdict::wrong_count:
      return "wrong count";
    case Verdict::inaccurate:
      return "inaccurate";
    case Verdict::unstable:
      return "unstable";
    case Verdict::failed:
      return "failed";
    case Verdict::refused:
      return "refused";
    case Verdict::not_run:
      return "not run";
  }
  return "";
}

Verdict judge(const Result& run, const EventErrors& errors) {
  switch (run.outcome.kind) {
    case OutcomeKind::completed:
      return errors.all_correspond() ? Verdict::right : Verdict::wrong_count;
    case OutcomeKind::inaccurate:
    case OutcomeKind::chattering:
      return Verdict::inaccurate;
    case OutcomeKind::unstable:
    case OutcomeKind::left_validity:  // of a scene whose reference stays within it
      return Verdict::unstable;
    case OutcomeKind::solver_failed:
    case OutcomeKind::stopped:
      return Verdict::failed;
  }
  return Verdict::failed;
}

}  // namespace subimpact
