#pragma once

#include <string>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// The case with another method, named as for parse_method_name, and without history rows. Its step
/// and largest order stay (a method without an order has none), its table where it was meant for
/// this method, library events where the method has them. Throws InvalidCase for an unknown name.
Case with_method(const Case& input, const std::string& name);

/// `method`, or nystrom or erk where that method cannot take the tension, the supports that lift or
/// the damping of the case.
Method possible_method(const Case& input, Method method);

/// Whether the steps of central differences on the mesh of a case are not far shorter than those
/// that flights between contacts need. Those of short contacts last for the whole run; a method
/// that changes its step takes less time then, although each step takes longer.
bool central_differences_suit(Case input);

/// The order of a method at fixed steps where forces are smooth; 0: it has none, or shortens them.
int order_of(const Case& input, const ResolvedSettings& used);

/// Whether resolve() takes the case.
bool can_run(const Case& input);

}  // namespace subimpact
