// What the program chooses where a case leaves it open, from files of random scenes.

#include <fmt/format.h>

#include <random>

#include "case_with.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"
#include "testing.h"

namespace subimpact {
namespace {

// A beam of any ends, theory, section and place of the strike, down to 1/2000 of its length.
std::string random_scene(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>()(random));
  };
  const auto one_of = [&](const std::vector<std::string>& texts) {
    return texts[std::uniform_int_distribution<std::size_t>(0, texts.size() - 1)(random)];
  };
  const double length = between(0.05, 3.0), thickness = length * between(1e-3, 0.1);
  const double to_end = between(5e-4, 0.5);
  const std::string law =
      one_of({"'foundation'", "'hertz', stiffness = 1e9", "'linear', stiffness = 1e7"});
  return fmt::format(
      "beam = {{ length = {}, width = {}, thickness = {}, density = 7850, youngs_modulus = 2.1e11, "
      "yield_stress = {}, theory = {}, poisson = 0.3, ends = {} }}\n"
      "striker = {{ mass = {}, velocity = {}{}, position = {} }}\n"
      "contact = {{ law = {} }}\ntime = {{ end = {} }}\n",
      length, thickness * between(1.0, 10.0), thickness, one_of({"inf", "355e6"}),
      one_of({"'rayleigh'", "'euler-bernoulli'", "'timoshenko'"}),
      one_of({"['pinned', 'pinned']", "['clamped', 'free']", "['free', 'clamped']",
              "['clamped', 'clamped']", "['pinned', 'clamped']"}),
      between(1e-3, 10.0), between(0.1, 10.0), law == "'foundation'" ? ", nose_radius = 0.01" : "",
      one_of({"-", "+"}) == "-" ? to_end : 1.0 - to_end, law, between(1e-4, 1e-2));
}

// SUBIMPACT_SCENES in the environment: how many; 60 by default.
TEST(RandomScenes, WithTheMeshLeftOpenAreNotRefusedForIt) {
  const char* asked = std::getenv("SUBIMPACT_SCENES");
  std::mt19937 random(5);
  for (int i = 0; i < (asked != nullptr ? std::atoi(asked) : 60); ++i) {
    const std::string text = random_scene(random);
    try {
      const LoadedCase loaded = read_case_text(text, "scene.toml");
      resolve(loaded.value);
      const Case first = first_run(loaded.value, loaded.given).input;
      resolve(first);
      for (const CaseBeside& beside : cases_beside(first)) resolve(beside.input);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << '\n' << text;
    }
  }
}

}  // namespace
}  // namespace subimpact
