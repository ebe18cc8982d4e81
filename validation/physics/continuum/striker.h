#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "nodes.h"
#include "scene.h"

namespace continuum {

// Nodes of the struck surface near the nose, which may touch it.
struct Surface {
  std::vector<int> node;
  std::vector<double> x, z, stiffness;  // reference position; penalty * m/dt0^2

  void add(int n, double at_x, double at_z, double k) {
    node.push_back(n);
    x.push_back(at_x);
    z.push_back(at_z);
    stiffness.push_back(k);
  }
};

// One contact: from the nearest node's first penetration to its last, with the largest gap until
// the next. Separations shorter than Scene::bounce do not end it: single nodes bounce on a penalty.
// The force is a mean over Scene::interval.
struct Contact {
  double start = 0.0, end = 0.0, impulse = 0.0, largest_force = 0.0, penetration = 0.0,
         opening = 0.0, speed_after = 0.0;
};

// A rigid nose with one degree of freedom: m dV/dt = -F. A node inside it by p > 0 is pushed out
// along the normal with k p; k is a multiple of the node's mass over dt0^2, dt0 = 0.6 of the
// critical step: it costs no stability there. Where k dt^2/m is near 1 or above, single nodes
// bounce and energy is gained; half the step then keeps it.
class Striker {
 public:
  Striker(const Scene& s, double parts)
      : parts_(parts),
        mass_(s.mass),
        radius_(s.radius),
        speed_(s.mode > 0 ? 0.0 : s.speed),
        is_ball_(s.nose == "ball"),
        bounce_(s.bounce) {}

  // Adds the forces of the nose at displacement u() to those of the nodes.
  void press(const Surface& surface, Nodes& nodes) {
    const auto& [ux, uy, uz] = nodes.u;
    auto& [fx, fy, fz] = nodes.f;
    double sum = 0.0, energy = 0.0, nearest = 1e300;
    for (std::size_t i = 0; i < surface.node.size(); ++i) {
      const int n = surface.node[i];
      const double x = surface.x[i] + ux[n], y = uy[n] - u_ + radius_;
      const double z = is_ball_ ? surface.z[i] + uz[n] : 0.0;
      const double distance = std::sqrt(x * x + y * y + z * z), gap = distance - radius_;
      nearest = std::min(nearest, gap);
      if (gap >= 0.0) continue;
      const double push = -surface.stiffness[i] * gap / distance;
      fx[n] += push * x;
      fy[n] += push * y;
      fz[n] += push * z;
      sum += push * y;
      energy += 0.5 * surface.stiffness[i] * gap * gap;
    }
    force_ = parts_ * sum;
    penalty_energy_ = parts_ * energy;
    gap_ = nearest;
  }

  // Takes part in the record of contacts, then moves over a step.
  void advance(double t, double dt) {
    record(t, dt);
    previous_gap_ = gap_;
    speed_ -= dt * force_ / mass_;
    u_ += dt * speed_;
  }

  double u() const { return u_; }
  double speed() const { return speed_; }  // half a step before the forces of press()
  double force() const { return force_; }
  double gap() const { return gap_; }
  double penalty_energy() const { return penalty_energy_; }
  double impulse() const { return impulse_; }
  double penetration_at_4_kN() const { return penetration_at_4_kN_; }

  // The mean force since the last call; notes the mean penetration of the nearest node with it.
  double mean_force(double t) {
    const double mean = t > noted_ ? (impulse_ - noted_impulse_) / (t - noted_) : 0.0;
    if (mean <= 4000.0 && t > noted_)
      penetration_at_4_kN_ = std::max(penetration_at_4_kN_, penetration_ / (t - noted_));
    noted_ = t;
    noted_impulse_ = impulse_;
    penetration_ = 0.0;
    if (!contacts_.empty())
      contacts_.back().largest_force = std::max(contacts_.back().largest_force, mean);
    return mean;
  }

  double largest_force() const {
    double largest = 0.0;
    for (const Contact& c : contacts_) largest = std::max(largest, c.largest_force);
    return largest;
  }
  double mass() const { return mass_; }
  double kinetic_energy(double dt) const {
    return 0.5 * mass_ * speed_ * (speed_ - dt * force_ / mass_);
  }

  void write_contacts(const std::string& folder) const {
    std::ofstream file(folder + "/contacts.csv");
    file << "start_us,end_us,impulse_Ns,largest_force_N,penetration_um,opening_um,striker_m_s\n";
    char line[200];
    for (const Contact& c : contacts_) {
      const bool lasts = in_contact_ && &c == &contacts_.back();
      std::snprintf(line, sizeof line, "%.2f,%.2f,%.5g,%.5g,%.4f,%.5g,%.6g\n", 1e6 * c.start,
                    lasts ? NAN : 1e6 * c.end, c.impulse, c.largest_force, 1e6 * c.penetration,
                    lasts ? NAN : 1e6 * c.opening, lasts ? NAN : c.speed_after);
      file << line;
    }
  }

 private:
  void record(double t, double dt) {
    const bool touches = gap_ < 0.0;
    if (touches && !in_contact_) {
      const double start = t > 0.0 ? zero(t, dt) : 0.0;
      if (contacts_.empty() || start - contacts_.back().end >= bounce_)
        contacts_.push_back({.start = start});
      contacts_.back().opening = 0.0;
    }
    if (!touches && in_contact_) contacts_.back().speed_after = speed_;
    in_contact_ = touches;
    if (contacts_.empty()) return;
    Contact& c = contacts_.back();
    if (touches) {
      c.end = t;
      c.impulse += dt * force_;
      impulse_ += dt * force_;
      penetration_ -= dt * gap_;
      c.penetration = std::max(c.penetration, -gap_);
    } else {
      if (c.opening == 0.0) c.end = zero(t, dt);
      c.opening = std::max(c.opening, gap_);
    }
  }

  double zero(double t, double dt) const { return t - dt * gap_ / (gap_ - previous_gap_); }

  double parts_, mass_, radius_, speed_, u_ = 0.0;
  bool is_ball_, in_contact_ = false;
  double bounce_;
  double force_ = 0.0, gap_ = 0.0, previous_gap_ = 0.0, penalty_energy_ = 0.0, impulse_ = 0.0;
  double penetration_at_4_kN_ = 0.0, penetration_ = 0.0, noted_ = 0.0, noted_impulse_ = 0.0;
  std::vector<Contact> contacts_;
};

}  // namespace continuum
