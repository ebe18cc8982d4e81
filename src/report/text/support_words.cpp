#include "report/text/support_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/problem.h"
#include "report/text/uncertain.h"

namespace subimpact {
namespace {

constexpr double felt_force = 1e-3;  // over the largest

std::string words_of(const std::vector<SupportContact>& contacts, const Result& result) {
  const auto time = [&](double value, const std::optional<double>& error) {
    const ReadUnit unit = unit_for(result.outcome.time, as_instant);
    return with_unit(error ? number_in(unit, {value, error}, as_time.most_digits)
                           : with_digits(unit.per_si * value, 4),
                     unit);
  };
  if (contacts.empty()) return "the beam never touches it";
  const SupportContact& first = contacts.front();
  std::string words;
  if (first.start > 0.0) words = "touches at " + time(first.start, first.start_error);
  if (!first.end) return words.empty() ? "the beam never lifts off" : words + ", and stays";
  words +=
      fmt::format("{}lifts at {}", words.empty() ? "" : ", ", time(*first.end, first.end_error));
  if (contacts.size() > 1) {
    words += ", back at " + time(contacts[1].start, contacts[1].start_error);
  }
  const auto n = std::ranges::count_if(contacts, [](const auto& c) { return c.end.has_value(); });
  return n > 1 ? fmt::format("{}; {} times", words, n) : words;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> support_words(const Case& input,
                                                               const Result& result) {
  std::vector<std::pair<std::string, std::string>> lines;
  const Beam beam = sized_beam(input);
  double largest = 0.0;
  for (const auto& contact : result.support_contacts) {
    largest = std::max(largest, contact.peak_force);
  }
  for (const Spring& spring : beam.springs) {
    if (!spring.one_sided) continue;
    std::vector<SupportContact> contacts;
    const std::size_t index = static_cast<std::size_t>(&spring - beam.springs.data());
    for (const SupportContact& contact : result.support_contacts) {
      const bool is_here = contact.position == spring.position * beam.length;
      const bool is_own = contact.spring == index || result.used.half_model;
      if (is_here && is_own && contact.peak_force >= felt_force * largest) {
        contacts.push_back(contact);
      }
    }
    lines.emplace_back(
        fmt::format("{} at {:.4g} m", spring.one_sided->gap > 0.0 ? "stop" : "support",
                    spring.position * beam.length),
        words_of(contacts, result));
  }
  return lines;
}

}  // namespace subimpact
