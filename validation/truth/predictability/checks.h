#pragma once

#include "subimpact/study/judgement/judgement.h"

namespace subimpact::predictability {

// Each prints a table and returns whether its claim holds.
bool check_table(Jobs jobs);
bool check_identities(Jobs jobs);
bool check_merges(Jobs jobs);
bool check_coverage(Jobs jobs);
bool check_cost(Jobs jobs);
bool check_scatter(Jobs jobs);

}  // namespace subimpact::predictability
