#include "subimpact/simulate/assessment.h"

#include <fmt/format.h>

#include "numerics/units.h"

namespace subimpact {
namespace {

// In the order of the kinds. u_: in us or um; _2: the same with two significant digits.
// clang-format off
constexpr const char* sentences[] = {
    "{what}",
    "it does not exist with {what}",
    "it is split or merged or does not end with {what}",
    "there is one with {what}",
    "there is another one with {what}",
    "the run with {what} stopped before its end, at {instant}",
    "its indentation is {u_value_2} um with an error of {u_error_2} um",
    "the opening before it is {u_value_2} um with an error of {u_error_2} um",
    "the opening after it is {u_value_2} um with an error of {u_error_2} um",
    "the opening before it is {u_value:.3g} um with an error of {u_error:.2g} um, and contacts parted by less than {u_limit:.4g} um are joined",
    "the opening after it is {u_value:.3g} um with an error of {u_error:.2g} um, and contacts parted by less than {u_limit:.4g} um are joined",
    "the largest opening within it is {u_value:.3g} um with an error of {u_error:.2g} um, and contacts parted by less than {u_limit:.4g} um are joined",
    "its duration is {u_value_2} us with an error of {u_error_2} us",
    "the separation before it is {u_value_2} us with an error of {u_error_2} us",
    "the separation after it is {u_value_2} us with an error of {u_error_2} us",
    "at {instant} the contact nearly opens: {u_value_2} um are left with an error of {u_error_2} um",
    "at {instant} the gap nearly closes: {u_value_2} um are left with an error of {u_error_2} um",
    "the part of the mesh under the striker is {value:.2g} times as heavy as it",
    "the strike is {value:.2g} cells of the mesh from an end",
    "it lasts to the end and {value:.0f} parts of the mesh do not resolve the bending waves of contacts as short as {u_time:.2g} us as {limit:.0f} would",
    "its contact lasts {u_value:.2g} us and the mesh shows none shorter than {u_limit:.2g} us: it does not resolve the bending waves",
    "the separation after it lasts {u_value:.2g} us and the mesh shows none shorter than {u_limit:.2g} us: it does not resolve the bending waves",
    "elements do not resolve where the beam yields under the striker: use model.mesh = \"cells\"",
    "solver.rtol = {value:.2g} is too loose for runs to show each other's errors",
    "the error of its times is {u_error:.2g} us",
    "no coarser run is possible that shows the error",
    "{what} is fixed by the case",
    "a finer mesh would take the counted work from {value:.1e} to {error:.1e}, above the limit of {limit:.1e}",
    "a finer mesh would take the counted work from {value:.1e} to {error:.1e}, above the limit of {limit:.1e} for a run without a tolerance",
    "the mesh is the finest that is allowed",
    "on a finer mesh {what}",
    "the run on the next mesh failed ({what})",
    "the search was stopped",
};
// clang-format on

}  // namespace

std::string words_of(const Reason& reason) {
  const double u_value = um * reason.value, u_error = um * reason.error;
  return (reason.sub_impact ? fmt::format("sub-impact {}: ", *reason.sub_impact + 1) : "") +
         fmt::format(fmt::runtime(sentences[static_cast<std::size_t>(reason.kind)]),
                     fmt::arg("what", reason.what), fmt::arg("value", reason.value),
                     fmt::arg("error", reason.error), fmt::arg("limit", reason.limit),
                     fmt::arg("u_value", u_value), fmt::arg("u_error", u_error),
                     fmt::arg("u_limit", um * reason.limit), fmt::arg("u_time", us * reason.time),
                     fmt::arg("instant", instant_text(reason.time)),
                     fmt::arg("u_value_2", with_significant(u_value, 2)),
                     fmt::arg("u_error_2", with_significant(u_error, 2)));
}

std::string words_of(const std::optional<Reason>& reason) {
  return reason ? words_of(*reason) : std::string();
}

}  // namespace subimpact
