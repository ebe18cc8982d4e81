#include "report/text/strike_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "case/problem.h"
#include "report/text/uncertain.h"

namespace subimpact {
namespace {

std::string mass_text(double mass) {
  if (mass >= 1e4) return fmt::format("{:.4g} t", 1e-3 * mass);
  const ReadUnit unit = unit_for(1e3 * mass, {"g", 3});
  return with_unit(fmt::format("{:.4g}", unit.per_si * 1e3 * mass), unit);
}

std::string end_name(const Beam& beam, std::size_t end) {
  return beam.rests[end] ? "resting" : name_of(beam.ends[end]);
}

std::string striker_words(const Scene& scene, const std::string& contact) {
  const Striker& striker = scene.striker;
  const std::string law = contact.empty() ? "" : " (" + contact + ")";
  if (striker.fixed) return "a stop" + law;
  return fmt::format(
      "{} at {:.4g} m/s{}{}", mass_text(striker.mass), scene.bodies().striker_velocity(),
      striker.drop_height ? fmt::format(" after a fall of {:.4g} m", *striker.drop_height) : "",
      law);
}

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

std::string others_in_scene(const Scene& scene) {
  const Beam& beam = scene.beam;
  std::vector<std::string> words;
  const auto add = [&](bool is_there, std::string what) {
    if (is_there) words.push_back(std::move(what));
  };
  add(scene.gravity != 0.0, fmt::format("gravity {:.6g} m/s2", scene.gravity));
  add(scene.gravity == 0.0 && scene.striker.drop_height,
      "gravity sets the velocity and does not act in the run");
  add(beam.load != 0.0, fmt::format("load {:.6g} N/m", beam.load));
  add(!beam.forces.empty(), counted(beam.forces.size(), "force"));
  const auto n_one_sided = static_cast<std::size_t>(
      std::ranges::count_if(beam.springs, [](const Spring& s) { return s.one_sided.has_value(); }));
  const std::size_t n_springs = beam.springs.size() - n_one_sided;
  add(n_springs > 0, counted(n_springs, "spring"));
  add(n_one_sided > 0, counted(n_one_sided, "support") + " that it can lift off");
  add(beam.foundation > 0.0, fmt::format("bedding {:.6g} N/m2", beam.foundation));
  add(beam.start == BeamStart::equilibrium || beam.rests[0] || beam.rests[1],
      "beam in equilibrium at the start");
  add(beam.velocity != 0.0, fmt::format("beam moving at {:.6g} m/s", beam.velocity));
  add(beam.angular_velocity != 0.0,
      fmt::format("beam turning at {:.6g} rad/s about {:.6g} of its length", beam.angular_velocity,
                  beam.used_pivot()));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string strike_words(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  const double x = scene.striker.position;
  const std::string where = x == 0.5 ? std::string("the middle")
                            : x == 0.0 || x == 1.0
                                ? fmt::format("the {} end", end_name(scene.beam, x == 1.0))
                                : fmt::format("{:.4g} of the length", x);
  const std::string others = others_in_scene(scene);
  const std::size_t n = result.strikes.size();
  return fmt::format(
      "{}{}, {}{}", n > 1 ? fmt::format("the last of {}: ", n) : "",
      striker_words(scene, contact_words(input)),
      scene.beam.fixed ? std::string("on a plane that does not move")
                       : fmt::format("at {} of a {}-{} beam of {}", where, end_name(scene.beam, 0),
                                     end_name(scene.beam, 1), mass_text(scene.beam.mass())),
      others.empty() ? "" : "; " + others);
}

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
