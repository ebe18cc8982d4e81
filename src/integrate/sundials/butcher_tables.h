#pragma once

#include <cstdio>  // arkode_butcher.h names FILE without it

#include <arkode/arkode_butcher.h>

#include <string>

#include "integrate/sundials/linear_algebra.h"

namespace subimpact {

using ButcherTablePointer = Owned<ARKodeButcherTable, ARKodeButcherTable_Free>;

/// The named table, its last stage the next step's first; the first of explicit_tables() for an
/// empty name. Throws std::invalid_argument for a name that is not among them.
ButcherTablePointer load_explicit_table(const std::string& name);

/// The named table of dirk_tables(), likewise.
ButcherTablePointer load_dirk_table(const std::string& name);

}  // namespace subimpact
