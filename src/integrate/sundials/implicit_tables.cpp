#include <stdexcept>

#include "integrate/arkode_ark.h"
#include "integrate/sundials/butcher_tables.h"

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

namespace subimpact {
namespace {

struct Entry {
  const char* name;
  ARKODE_DIRKTableID implicit;
  ARKODE_ERKTableID explicit_part;  // of the pair; ARKODE_ERK_NONE: there is none
  const char* note;
};

// "ESDIRK": explicit first stage, one diagonal entry throughout. All are A-stable; "stiffly
// accurate" ones (whose last stage is the step's end) are L-stable.
// clang-format off
const Entry entries[] = {
    {"esdirk547", ARKODE_ESDIRK547L2SA_7_4_5, ARKODE_ERK_NONE, "Kennedy and Carpenter 2019, ESDIRK5(4)7L[2]SA"},
    {"esdirk437", ARKODE_ESDIRK437L2SA_7_3_4, ARKODE_ERK_NONE, "Kennedy and Carpenter 2019, ESDIRK4(3)7L[2]SA: least damping of its order"},
    {"esdirk436", ARKODE_ESDIRK436L2SA_6_3_4, ARKODE_ERK_NONE, "Kennedy and Carpenter 2016, ESDIRK4(3)6L[2]SA"},
    {"esdirk325", ARKODE_ESDIRK325L2SA_5_2_3, ARKODE_ERK_NONE, "Kennedy and Carpenter 2016, ESDIRK3(2)5L[2]SA"},
    {"ark437", ARKODE_ARK437L2SA_DIRK_7_3_4, ARKODE_ARK437L2SA_ERK_7_3_4, "Kennedy and Carpenter 2019, ARK4(3)7L[2]SA"},
    {"ark436", ARKODE_ARK436L2SA_DIRK_6_3_4, ARKODE_ARK436L2SA_ERK_6_3_4, "Kennedy and Carpenter 2003, ARK4(3)6L[2]SA"},
    {"ark548", ARKODE_ARK548L2SA_DIRK_8_4_5, ARKODE_ARK548L2SA_ERK_8_4_5, "Kennedy and Carpenter 2003, ARK5(4)8L[2]SA"},
    {"ark548b", ARKODE_ARK548L2SAb_DIRK_8_4_5, ARKODE_ARK548L2SAb_ERK_8_4_5, "Kennedy and Carpenter 2019, ARK5(4)8L[2]SAb"},
    {"ark324", ARKODE_ARK324L2SA_DIRK_4_2_3, ARKODE_ARK324L2SA_ERK_4_2_3, "Kennedy and Carpenter 2003, ARK3(2)4L[2]SA"},
    {"kvaerno-7-4-5", ARKODE_KVAERNO_7_4_5, ARKODE_ERK_NONE, "Kvaerno 2004, ESDIRK5/4"},
    {"sdirk-5-3-4", ARKODE_SDIRK_5_3_4, ARKODE_ERK_NONE, "Hairer and Wanner, SDIRK4: five implicit stages"},
    {"trbdf2", ARKODE_TRBDF2_3_3_2, ARKODE_ERK_NONE, "Bank et al. 1985: trapezoidal rule, then BDF2"},
    {"sdirk-2-1-2", ARKODE_SDIRK_2_1_2, ARKODE_ERK_NONE, "two implicit stages: the cheapest step"},
};
// clang-format on

const Entry& find(const std::string& name, bool pair) {
  for (const Entry& entry : entries) {
    if (pair && entry.explicit_part == ARKODE_ERK_NONE) continue;
    if (name.empty() || entry.name == name) return entry;
  }
  throw std::invalid_argument(
      (pair ? "unknown pair of Runge-Kutta tables '" : "unknown implicit Runge-Kutta table '") +
      name + "'");
}

ButcherTablePointer checked(ARKodeButcherTable table, const Entry& entry) {
  if (!table) throw std::runtime_error(std::string("SUNDIALS has no table ") + entry.name);
  return ButcherTablePointer(table);
}

ButcherTablePointer implicit_table(const Entry& entry) {
  return checked(ARKodeButcherTable_LoadDIRK(entry.implicit), entry);
}

std::vector<CoefficientTable> list_tables(bool pairs) {
  std::vector<CoefficientTable> list;
  for (const Entry& entry : entries) {
    if (pairs && entry.explicit_part == ARKODE_ERK_NONE) continue;
    const ButcherTablePointer table = implicit_table(entry);
    list.push_back({entry.name, table->q, table->p, table->stages, entry.note});
  }
  return list;
}

}  // namespace

const std::vector<CoefficientTable>& dirk_tables() {
  static const std::vector<CoefficientTable> tables = list_tables(false);
  return tables;
}

const std::vector<CoefficientTable>& imex_tables() {
  static const std::vector<CoefficientTable> tables = list_tables(true);
  return tables;
}

ButcherTablePointer load_dirk_table(const std::string& name) {
  return implicit_table(find(name, false));
}

ButcherTablePair load_imex_tables(const std::string& name) {
  const Entry& entry = find(name, true);
  return {implicit_table(entry), checked(ARKodeButcherTable_LoadERK(entry.explicit_part), entry)};
}

}  // namespace subimpact
