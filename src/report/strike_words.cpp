#include "report/strike_words.h"

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
  std::string text = fmt::format("What looks like one blow is {} in {}",
                                 counted(hits.size(), "sub-impact"), counted(zones.size(), "zone"));
  text += decided_words(result);
  if (hits.size() == 1) text = "The strike is a single contact";
  text += hits.back().end
              ? fmt::format("; the last separation comes at {}. ", duration_text(*hits.back().end))
              : "; the run ended while the bodies still touched. ";
  if (hits.size() > 1) {
    for (std::size_t k = 0; k < zones.size(); ++k) {
      const ZoneSummary& zone = zones[k];
      text += fmt::format(
          "Zone {}, {} to {}, holds {} in {}. ", zone.zone, duration_text(zone.start),
          zone.end ? duration_text(*zone.end) : "the end of the run",
          counted(zone.n_sub_impacts, "sub-impact"), counted(zone.n_subzones, "sub-zone"));
      if (k + 1 < zones.size() && zone.end) {
        text += fmt::format("Then the bodies are apart for {}. ",
                            duration_text(zones[k + 1].start - *zone.end));
      }
    }
  }
  double impulse = 0.0;
  for (const SubImpact& s : hits) impulse += s.impulse;
  const SubImpact& first = hits.front();
  text += fmt::format("The first contact lasts {}, peaks at {:.4g} N and carries {:.3g} N s",
                      duration_text(result.end_of(first) - first.start), first.peak_force,
                      first.impulse);
  if (hits.size() > 1) text += fmt::format(", {:.0f} % of all", 100.0 * first.impulse / impulse);
  return text + ".";
}

std::string yield_words(const Case& input, const Result& result) {
  std::string text;
  if (result.first_contact_yield) {
    text += fmt::format("The contact first yields after {}, at an indentation of {:.4g} mm",
                        duration_text(*result.first_contact_yield),
                        1e3 * result.used.yield_indentation);
    const std::size_t again = yielding_again(result).size();
    text += again == 0 ? "; no later sub-impact yields further. "
                       : fmt::format("; {} later {} further. ", again,
                                     again == 1 ? "sub-impact yields" : "sub-impacts yield");
  } else {
    text += "The contact stays elastic. ";
  }
  if (result.first_section_yield) {
    text +=
        fmt::format("A fibre of the beam first yields after {}; by the end {} of {} {}{} yielded.",
                    duration_text(*result.first_section_yield), result.n_yielded_sections,
                    counted(result.used.n_sections, "section"),
                    result.used.half_model ? "(of the half that is modelled) " : "",
                    result.n_yielded_sections == 1 ? "has" : "have");
  } else {
    text += input.model.section == SectionKind::elastic
                ? "The beam's sections are modelled as elastic."
                : "No section of the beam yields.";
  }
  return text;
}

// A number with the digits that its error allows; two where the error is not known.
std::string certain_digits(const Result& result, double value, double error) {
  if (!result.error_estimate) return fmt::format("{:.4g}", value);
  const std::optional<Rounding> rounding = rounding_of(error, 6);
  return rounding ? with_decimals(value, rounding->decimals) : with_two_digits(value);
}

std::string striker_words(const Case& input, const Result& result, const StrikeAccount& account) {
  const double first = result.history.front().striker_energy;
  const double left = first - account.striker_loss;
  const double error = final_errors(input, result).striker_velocity;
  const double mass = input.scene.striker.mass;  // dU = m v dv
  std::string text =
      fmt::format("The striker enters with {:.4g} J and leaves with {} J at {} m/s. ", first,
                  certain_digits(result, left, mass * std::abs(result.striker_velocity) * error),
                  certain_digits(result, result.striker_velocity, error));
  if (account.striker_gain <= negligible_gain * first) {
    text += "At no time does it gain energy: measured by the striker there is no recovery.";
  } else {
    text += fmt::format(
        "It gains energy at times, up to {:.3g} J above an earlier value: measured "
        "by the striker there is a recovery.",
        account.striker_gain);
  }
  return text;
}

// "rises from 1.01 J to 3.34 J".
std::string change_words(const StrikePart& part) {
  return fmt::format("{} from {:.3g} J to {:.3g} J",
                     part.elastic_change() > 0.0 ? "rises" : "falls", part.elastic_start,
                     part.elastic_end);
}

std::string part_name(const StrikePart& part) {
  using Kind = StrikePart::Kind;
  switch (part.kind) {
    case Kind::zone:
      return fmt::format("over zone {}", part.zone);
    case Kind::subzone:
      return fmt::format("in sub-zone {} of zone {}", part.subzone, part.zone);
    case Kind::subzone_separation:
      return fmt::format("in the separation after that sub-zone");
    case Kind::separation:
      return fmt::format("in the separation after zone {}", part.zone);
  }
  return {};
}

std::string recovery_words(const StrikeAccount& account) {
  using Kind = StrikePart::Kind;
  const auto is_divided = [&](int zone) {
    return std::any_of(account.parts.begin(), account.parts.end(), [&](const StrikePart& part) {
      return part.kind == Kind::subzone_separation && part.zone == zone;
    });
  };
  std::vector<std::string> of_zones, within_zones;
  for (const StrikePart& part : account.parts) {
    const std::string words = change_words(part) + " " + part_name(part);
    if (part.kind == Kind::zone || part.kind == Kind::separation) {
      of_zones.push_back(words);
    } else if (is_divided(part.zone)) {
      within_zones.push_back(words);
    }
  }
  if (of_zones.size() > 1) of_zones.back() = "and " + of_zones.back();
  std::string text =
      fmt::format("The beam's elastic bending energy separates compression from recovery. It {}. ",
                  fmt::join(of_zones, ", "));
  if (!within_zones.empty()) {
    text += fmt::format("Within zones: it {}. ", fmt::join(within_zones, ", "));
  }
  text += fmt::format(
      "Its largest value, {:.3g} J, is reached at {}; what follows is recovery, down "
      "to {:.3g} J at the last separation.",
      account.largest_elastic, duration_text(account.largest_elastic_at), account.elastic_at_end);
  return text;
}

}  // namespace

std::vector<std::size_t> yielding_again(const Result& result) {
  std::vector<std::size_t> found;
  const auto& hits = result.sub_impacts;
  for (std::size_t i = 1; i < hits.size(); ++i) {
    if (hits[i].residual_indentation > hits[i - 1].residual_indentation) found.push_back(i);
  }
  return found;
}

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
