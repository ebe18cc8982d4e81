#pragma once

#include <vector>

#include "scenes.h"

namespace grazes {

/// Events of a scene by a Taylor series of order 20 in time, a peer made for this study as heyoka
/// (https://bluescarni.github.io/heyoka/) works: each step ends before the series' terms matter;
/// the series of the indentation over the step is a polynomial; its roots are isolated by
/// Descartes' rule of signs and bisection, and refined; the step then ends at the first. heyoka
/// forgets events for a while after one; here the root at the start is divided out instead, so that
/// none is forgotten.
std::vector<Event> events_by_taylor_series(const Scene& scene);

}  // namespace grazes
