#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace grazes {
namespace {

using namespace subimpact;

// F = K lambda.
class Spring final : public ContactLaw {
 public:
  explicit Spring(double stiffness) : stiffness_(stiffness) {}
  std::string name() const override { return "spring"; }
  ContactScales scales() const override { return {stiffness_, 1.0}; }
  double force(ContactHistory, double indentation) const override {
    return stiffness_ * indentation;
  }
  double slope(ContactHistory, double) const override { return stiffness_; }
  double recoverable_energy(ContactHistory, double indentation) const override {
    return 0.5 * stiffness_ * indentation * indentation;
  }

 private:
  double stiffness_;
};

// Unknowns are modes. The bending stiffness is 1 N m2 and the weight of a section the stiffness of
// its mode, so that no product rounds it.
class ModesMesh final : public BeamMesh {
 public:
  explicit ModesMesh(const std::vector<Mode>& modes)
      : BeamMesh(modes.size(), 0, false), modes_(modes) {
    for (std::size_t k = 0; k < modes.size(); ++k) {
      mass_.at(k, k) = modes[k].mass;
      weights_.push_back(1.0 / static_cast<double>(modes.size()));  // of the length of 1 m
      bends_.push_back(std::sqrt(modes[k].stiffness / weights_.back()));
      positions_.push_back(static_cast<double>(k + 1) / static_cast<double>(modes.size() + 1));
      struck_point_.terms.push_back({k, modes[k].displacement});
      momentum_functional_.push_back(modes[k].mass);
      beam_mass_ += modes[k].mass;
    }
    first_end_.terms = {{0, 0.0}};
  }
  void curvatures(std::span<const double> q, std::span<double> kappa) const override {
    for (std::size_t k = 0; k < modes_.size(); ++k) kappa[k] = bends_[k] * q[k];
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    for (std::size_t k = 0; k < modes_.size(); ++k)
      forces[k] = -weights_[k] * bends_[k] * moments[k];
  }
  SectionStencil section_stencil(std::size_t section) const override {
    return {section, std::span(bends_).subspan(section, 1)};
  }
  double highest_frequency(double stiffness) const override {
    double highest = 0.0;
    for (const Mode& mode : modes_) highest = std::max(highest, mode.stiffness / mode.mass);
    return std::sqrt(stiffness * highest);
  }
  NaturalModes natural_modes(double stiffness) const override {
    NaturalModes natural;
    natural.shapes.assign(modes_.size() * modes_.size(), 0.0);
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      natural.frequencies.push_back(std::sqrt(stiffness * modes_[k].stiffness / modes_[k].mass));
      natural.shapes[k * modes_.size() + k] = 1.0 / std::sqrt(modes_[k].mass);
    }
    return natural;
  }
  std::string description() const override { return "modes of the study's own"; }

 private:
  std::vector<Mode> modes_;
  std::vector<double> bends_;  // curvature per unknown
};

}  // namespace

double Scene::highest_frequency() const {
  double highest = 0.0;
  for (const Mode& mode : modes) highest = std::max(highest, mode.stiffness / mode.mass);
  return std::sqrt(highest);
}

double Scene::fastest() const {
  double compliance = 1.0 / striker_mass;
  for (const Mode& mode : modes) compliance += mode.displacement * mode.displacement / mode.mass;
  return std::hypot(highest_frequency(), std::sqrt(stiffness * compliance));
}

std::vector<Scene> read_scenes(const std::string& file) {
  std::ifstream in(file);
  std::vector<Scene> scenes;
  Scene scene;
  while (in >> scene.family >> scene.number >> scene.kind >> scene.depth >> scene.time >>
         scene.duration >> scene.end >> scene.striker_mass >> scene.velocity >> scene.stiffness) {
    std::size_t count = 0;
    in >> count;
    scene.modes.resize(count);
    for (Mode& mode : scene.modes) in >> mode.mass >> mode.stiffness >> mode.displacement;
    in >> count;
    scene.events.resize(count);
    for (Event& event : scene.events) {
      std::string word;
      in >> word >> event.time;
      event.begins = word == "begins";
    }
    if (!in) throw std::runtime_error(file + ": ends within a scene");
    scenes.push_back(scene);
  }
  if (scenes.empty()) throw std::runtime_error(file + ": holds no scenes");
  return scenes;
}

Problem problem_of(const Scene& scene) {
  Problem problem;
  const auto modes = std::make_shared<ModesMesh>(scene.modes);
  problem.beam = {.length = 1.0,
                  .width = 1.0,
                  .thickness = 1.0,
                  .density = modes->beam_mass(),
                  .youngs_modulus = 12.0};
  problem.striker.mass = scene.striker_mass;
  problem.striker.velocity = scene.velocity;
  problem.mesh = modes;
  problem.contact_law = std::make_shared<Spring>(scene.stiffness);
  problem.may_yield = false;
  return problem;
}

}  // namespace grazes
