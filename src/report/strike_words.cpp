#include "report/page_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "case/counted.h"
#include "io/sub_impact_rows.h"
#include "io/uncertain.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"
#include "subimpact/study/strike_account.h"

namespace subimpact {
namespace {

// Rises of the striker's energy below this part of its first value are rounding and integration
// error.
constexpr double negligible_gain = 1e-6;

std::string sub_impact_words(const Result& result) {
  const auto& hits = result.sub_impacts;
  if (hits.empty()) return "The striker never touched the beam.";
  const std::vector<ZoneSummary> zones = summarise_zones(hits);
  const bool is_single = hits.size() == 1;
  std::string text = is_single ? "The strike is a single contact"
                               : fmt::format("What looks like one blow is {} in {}{}",
                                             counted(hits.size(), "sub-impact"),
                                             counted(zones.size(), "zone"), decided_words(result));
  text += hits.back().end
              ? fmt::format("; the last separation comes at {}. ", duration_text(*hits.back().end))
              : "; the run ended while the bodies still touched. ";
  double impulse = 0.0;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const ZoneSummary& zone = zones[k];
    impulse += zone.impulse;
    if (is_single) break;
    text += fmt::format("Zone {}, {} to {}, holds {} in {}. ", zone.zone, duration_text(zone.start),
                        zone.end ? duration_text(*zone.end) : "the end of the run",
                        counted(zone.n_sub_impacts, "sub-impact"),
                        counted(zone.n_subzones, "sub-zone"));
    if (k + 1 < zones.size() && zone.end) {
      text += fmt::format("Then the bodies are apart for {}. ",
                          duration_text(zones[k + 1].start - *zone.end));
    }
  }
  const SubImpact& first = hits.front();
  const std::string share =
      is_single ? "" : fmt::format(", {:.0f} % of all", 100.0 * first.impulse / impulse);
  return text +
         fmt::format("The first contact lasts {}, peaks at {:.4g} N and carries {:.3g} N s{}.",
                     duration_text(result.end_of(first) - first.start), first.peak_force,
                     first.impulse, share);
}

std::string yield_words(const Case& input, const Result& result) {
  std::string text = "The contact stays elastic. ";
  if (result.first_contact_yield) {
    const std::size_t again = yielding_again(result).size();
    text = fmt::format(
        "The contact first yields after {}, at an indentation of {:.4g} mm; {} later {} further. ",
        duration_text(*result.first_contact_yield), 1e3 * result.used.yield_indentation,
        again == 0 ? "no" : fmt::to_string(again),
        again < 2 ? "sub-impact yields" : "sub-impacts yield");
  }
  if (result.first_section_yield) {
    return text +
           fmt::format(
               "A fibre of the beam first yields after {}; by the end {} of {} {}{} yielded.",
               duration_text(*result.first_section_yield), result.n_yielded_sections,
               counted(result.used.n_sections, "section"),
               result.used.half_model ? "(of the half that is modelled) " : "",
               result.n_yielded_sections == 1 ? "has" : "have");
  }
  return text + (input.model.section == SectionKind::elastic
                     ? "The beam's sections are modelled as elastic."
                     : "No section of the beam yields.");
}

// A number with the digits that its error allows; two where the error is not known.
std::string certain_digits(const Result& result, double value, double error) {
  if (!result.error_estimate) return fmt::format("{:.4g}", value);
  const std::optional<Rounding> rounding = rounding_of(error, 6);
  return rounding ? with_decimals(value, rounding->decimals) : with_two_digits(value);
}

std::string striker_words(const Case& input, const Result& result, const StrikeAccount& account) {
  const double first = result.history.front().striker_energy;
  const double error = final_errors(input, result).striker_velocity;
  const double energy_error =  // dU = m v dv
      input.scene.striker.mass * std::abs(result.striker_velocity) * error;
  const std::string gain =
      account.striker_gain <= negligible_gain * first
          ? "At no time does it gain energy: measured by the striker there is no recovery."
          : fmt::format(
                "It gains energy at times, up to {:.3g} J above an earlier value: measured "
                "by the striker there is a recovery.",
                account.striker_gain);
  return fmt::format("The striker enters with {:.4g} J and leaves with {} J at {} m/s. {}", first,
                     certain_digits(result, first - account.striker_loss, energy_error),
                     certain_digits(result, result.striker_velocity, error), gain);
}

// "rises from 1.01 J to 3.34 J over zone 1".
std::string change_words(const StrikePart& part) {
  constexpr const char* places[] = {"over zone {}", "in sub-zone {1} of zone {0}",
                                    "in the separation after zone {}",
                                    "in the separation after that sub-zone"};  // by kind
  return fmt::format("{} from {:.3g} J to {:.3g} J ",
                     part.elastic_change() > 0.0 ? "rises" : "falls", part.elastic_start,
                     part.elastic_end) +
         fmt::format(fmt::runtime(places[static_cast<int>(part.kind)]), part.zone, part.subzone);
}

std::string recovery_words(const StrikeAccount& account) {
  using Kind = StrikePart::Kind;
  std::vector<std::string> of_zones, within_zones;
  for (const StrikePart& part : account.parts) {
    const bool is_divided = std::ranges::any_of(account.parts, [&](const StrikePart& other) {
      return other.kind == Kind::subzone_separation && other.zone == part.zone;
    });
    if (part.kind == Kind::zone || part.kind == Kind::separation) {
      of_zones.push_back(change_words(part));
    } else if (is_divided) {
      within_zones.push_back(change_words(part));
    }
  }
  if (of_zones.size() > 1) of_zones.back() = "and " + of_zones.back();
  return fmt::format(
      "The beam's elastic bending energy separates compression from recovery. It {}. {}Its largest "
      "value, {:.3g} J, is reached at {}; what follows is recovery, down to {:.3g} J at the last "
      "separation.",
      fmt::join(of_zones, ", "),
      within_zones.empty() ? ""
                           : fmt::format("Within zones: it {}. ", fmt::join(within_zones, ", ")),
      account.largest_elastic, duration_text(account.largest_elastic_at), account.elastic_at_end);
}

}  // namespace

std::vector<std::string> strike_words(const Case& input, const Result& result) {
  std::vector<std::string> paragraphs{sub_impact_words(result), yield_words(input, result)};
  if (!result.outcome.completed()) {
    paragraphs.insert(paragraphs.begin(), "Outcome: " + failure_message(input, result) + ".");
  }
  if (const auto account = account_of(result)) {
    paragraphs.push_back(striker_words(input, result, *account));
    paragraphs.push_back(recovery_words(*account));
  }
  return paragraphs;
}

}  // namespace subimpact
