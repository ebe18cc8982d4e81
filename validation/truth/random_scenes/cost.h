#pragma once

#include "subimpact/case/case.h"

namespace subimpact::scenes {

/// Roughly, the largest frequency of the drawn beam on its mesh, rad/s; 0 for a rigid beam.
double highest_frequency(const Case& input);

/// The same of the striker on the contact, the struck point held by the mass of its unknown.
double contact_frequency(const Case& input);

/// The stiffness of the contact at indentations as deep as the striker gets, N/m.
double contact_stiffness(const Case& input);

/// How long one contact with a rigid beam lasts, s.
double contact_time(const Case& input);

/// The beam's first flexural period, s, without rotary inertia.
double first_period(const Beam& beam);

/// A guess, good to a factor of five, at the seconds that a run takes for each second simulated.
double seconds_a_second(const Case& input);

}  // namespace subimpact::scenes
