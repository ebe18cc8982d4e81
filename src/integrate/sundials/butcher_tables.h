#pragma once

#include <cstdio>  // arkode_butcher.h names FILE without it

#include <arkode/arkode_butcher.h>

#include <memory>
#include <string>

namespace subimpact {

struct FreeButcherTable {
  void operator()(ARKodeButcherTableMem* table) const { ARKodeButcherTable_Free(table); }
};
using ButcherTablePointer = std::unique_ptr<ARKodeButcherTableMem, FreeButcherTable>;

/// The named table, its last stage the next step's first. Throws std::invalid_argument for a name
/// that is not among explicit_tables().
ButcherTablePointer load_explicit_table(const std::string& name);

/// The named table of dirk_tables(). Throws std::invalid_argument for any other name.
ButcherTablePointer load_dirk_table(const std::string& name);

struct ButcherTablePair {
  ButcherTablePointer implicit;
  ButcherTablePointer explicit_part;  // none for methods that are implicit throughout
};

/// The named pair of imex_tables(). Throws std::invalid_argument for any other name.
ButcherTablePair load_imex_tables(const std::string& name);

}  // namespace subimpact
