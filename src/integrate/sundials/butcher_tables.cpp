#include "integrate/sundials/butcher_tables.h"

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "integrate/sundials.h"

namespace subimpact {
namespace {

using Complex = std::complex<double>;

template <class Id>
struct Entry {
  const char* name;
  Id id;
  const char* note;
};
using ExplicitEntry = Entry<ARKODE_ERKTableID>;  // ARKODE_ERK_NONE: built here
using ImplicitEntry = Entry<ARKODE_DIRKTableID>;

// clang-format off
constexpr ExplicitEntry explicit_entries[] = {
    {"dop853", ARKODE_ERK_NONE, "Hairer, Norsett and Wanner, 8(5): fewest evaluations on an elastic beam"},
    {"dormand-prince", ARKODE_DORMAND_PRINCE_7_4_5, "Dormand and Prince 1980, 5(4): sound at every accuracy"},
    {"bogacki-shampine", ARKODE_BOGACKI_SHAMPINE_4_2_3, "Bogacki and Shampine 1989, 3(2): low accuracy"},
    {"zonneveld", ARKODE_ZONNEVELD_5_3_4, "Zonneveld 1963, 4(3)"},
    {"cash-karp", ARKODE_CASH_KARP_6_4_5, "Cash and Karp 1990, 5(4): the energy grows at every step, however short; for studies of that"},
    {"verner", ARKODE_VERNER_8_5_6, "Verner 1978, 6(5)"},
    {"fehlberg-78", ARKODE_FEHLBERG_13_7_8, "Fehlberg 1968, 8(7)"},
};

// "ESDIRK": explicit first stage, one diagonal entry throughout. All are A-stable; "stiffly
// accurate" ones (whose last stage is the step's end) are L-stable.
constexpr ImplicitEntry implicit_entries[] = {
    {"esdirk547", ARKODE_ESDIRK547L2SA_7_4_5, "Kennedy and Carpenter 2019, ESDIRK5(4)7L[2]SA"},
    {"esdirk437", ARKODE_ESDIRK437L2SA_7_3_4, "Kennedy and Carpenter 2019, ESDIRK4(3)7L[2]SA: least damping of its order"},
    {"esdirk436", ARKODE_ESDIRK436L2SA_6_3_4, "Kennedy and Carpenter 2016, ESDIRK4(3)6L[2]SA"},
    {"esdirk325", ARKODE_ESDIRK325L2SA_5_2_3, "Kennedy and Carpenter 2016, ESDIRK3(2)5L[2]SA"},
    {"ark437", ARKODE_ARK437L2SA_DIRK_7_3_4, "Kennedy and Carpenter 2019, ARK4(3)7L[2]SA"},
    {"ark436", ARKODE_ARK436L2SA_DIRK_6_3_4, "Kennedy and Carpenter 2003, ARK4(3)6L[2]SA"},
    {"ark548", ARKODE_ARK548L2SA_DIRK_8_4_5, "Kennedy and Carpenter 2003, ARK5(4)8L[2]SA"},
    {"ark548b", ARKODE_ARK548L2SAb_DIRK_8_4_5, "Kennedy and Carpenter 2019, ARK5(4)8L[2]SAb"},
    {"ark324", ARKODE_ARK324L2SA_DIRK_4_2_3, "Kennedy and Carpenter 2003, ARK3(2)4L[2]SA"},
    {"kvaerno-7-4-5", ARKODE_KVAERNO_7_4_5, "Kvaerno 2004, ESDIRK5/4"},
    {"sdirk-5-3-4", ARKODE_SDIRK_5_3_4, "Hairer and Wanner, SDIRK4: five implicit stages"},
    {"trbdf2", ARKODE_TRBDF2_3_3_2, "Bank et al. 1985: trapezoidal rule, then BDF2"},
    {"sdirk-2-1-2", ARKODE_SDIRK_2_1_2, "two implicit stages: the cheapest step"},
};
// clang-format on

ButcherTablePointer allocated(int stages) {
  ButcherTablePointer table(ARKodeButcherTable_Alloc(stages, SUNTRUE));
  if (!table) throw std::runtime_error("ARKodeButcherTable_Alloc failed");
  return table;
}

// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.10: the
// order-8 method of DOP853 with its error estimator of order 5 (b_embedded = b - error).
ButcherTablePointer dop853() {
  constexpr int n = 12;
  ButcherTablePointer table = allocated(n);
  table->q = 8;
  table->p = 5;
  // clang-format off
  const std::array<double, n> c = {0.0, 0.526001519587677318785587544488e-01,
      0.789002279381515978178381316732e-01, 0.118350341907227396726757197510e+00,
      0.281649658092772603273242802490e+00, 1.0 / 3.0, 0.25, 4.0 / 13.0,
      0.651282051282051282051282051282e+00, 0.6, 6.0 / 7.0, 1.0};
  const std::vector<std::vector<double>> a = {
      {},
      {5.26001519587677318785587544488e-2},
      {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
      {2.95875854768068491816892993775e-2, 0.0, 8.87627564304205475450678981324e-2},
      {2.41365134159266685502369798665e-1, 0.0, -8.84549479328286085344864962717e-1,
          9.24834003261792003115737966543e-1},
      {3.7037037037037037037037037037e-2, 0.0, 0.0, 1.70828608729473871279604482173e-1,
          1.25467687566822425016691814123e-1},
      {3.7109375e-2, 0.0, 0.0, 1.70252211019544039314978060272e-1,
          6.02165389804559606850219397283e-2, -1.7578125e-2},
      {3.70920001185047927108779319836e-2, 0.0, 0.0, 1.70383925712239993810214054705e-1,
          1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2,
          8.27378916381402288758473766002e-3},
      {6.24110958716075717114429577812e-1, 0.0, 0.0, -3.36089262944694129406857109825e0,
          -8.68219346841726006818189891453e-1, 2.75920996994467083049415600797e1,
          2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
      {4.77662536438264365890433908527e-1, 0.0, 0.0, -2.48811461997166764192642586468e0,
          -5.90290826836842996371446475743e-1, 2.12300514481811942347288949897e1,
          1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
          -2.03312017085086261358222928593e-2},
      {-9.3714243008598732571704021658e-1, 0.0, 0.0, 5.18637242884406370830023853209e0,
          1.09143734899672957818500254654e0, -8.14978701074692612513997267357e0,
          -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1,
          2.49360555267965238987089396762e0, -3.0467644718982195003823669022e0},
      {2.27331014751653820792359768449e0, 0.0, 0.0, -1.05344954667372501984066689879e1,
          -2.00087205822486249909675718444e0, -1.79589318631187989172765950534e1,
          2.79488845294199600508499808837e1, -2.85899827713502369474065508674e0,
          -8.87285693353062954433549289258e0, 1.23605671757943030647266201528e1,
          6.43392746015763530355970484046e-1},
  };
  const std::array<double, n> b = {5.42937341165687622380535766363e-2, 0.0, 0.0, 0.0, 0.0,
      4.45031289275240888144113950566e0, 1.89151789931450038304281599044e0,
      -5.8012039600105847814672114227e0, 3.1116436695781989440891606237e-1,
      -1.52160949662516078556178806805e-1, 2.01365400804030348374776537501e-1,
      4.47106157277725905176885569043e-2};
  const std::array<double, n> error = {0.1312004499419488073250102996e-01, 0.0, 0.0, 0.0, 0.0,
      -0.1225156446376204440720569753e+01, -0.4957589496572501915214079952e+00,
      0.1664377182454986536961530415e+01, -0.3503288487499736816886487290e+00,
      0.3341791187130174790297318841e+00, 0.8192320648511571246570742613e-01,
      -0.2235530786388629525884427845e-01};
  // clang-format on
  for (std::size_t i = 0; i < n; ++i) {
    table->c[i] = c[i];
    std::copy(a[i].begin(), a[i].end(), table->A[i]);
    table->b[i] = b[i];
    table->d[i] = b[i] - error[i];
  }
  return table;
}

// Appends the step's end as a last stage: no loss, as that evaluation is the next step's first.
ButcherTablePointer with_end_as_last_stage(const ARKodeButcherTableMem& from) {
  const int n = from.stages;
  ButcherTablePointer table = allocated(n + 1);
  table->q = from.q;
  table->p = from.p;
  for (int i = 0; i < n; ++i) {
    std::copy_n(from.A[i], n, table->A[i]);
    table->c[i] = from.c[i];
    table->b[i] = from.b[i];
    table->d[i] = from.d[i];
    table->A[n][i] = from.b[i];
  }
  table->c[n] = 1.0;
  table->b[n] = 0.0;
  table->d[n] = 0.0;
  return table;
}

bool ends_with_next_first(const ARKodeButcherTableMem& table) {
  const int last = table.stages - 1;
  for (int i = 0; i < table.stages; ++i) {
    if (std::abs(table.A[last][i] - table.b[i]) > 1e-14) return false;
  }
  return true;
}

// The named one of these entries; the first for an empty name.
template <class Entry, std::size_t n>
const Entry& find(const Entry (&entries)[n], const std::string& name) {
  for (const Entry& entry : entries) {
    if (name.empty() || entry.name == name) return entry;
  }
  throw std::invalid_argument("unknown Runge-Kutta table '" + name + "'");
}

ButcherTablePointer checked(ARKodeButcherTable table, const char* name) {
  if (!table) throw std::runtime_error(std::string("SUNDIALS has no table ") + name);
  return ButcherTablePointer(table);
}

// An explicit table ends on the next step's first stage, which costs nothing.
template <class Entry, std::size_t n, class Load>
std::vector<CoefficientTable> list(const Entry (&entries)[n], Load load, int n_free) {
  std::vector<CoefficientTable> list;
  for (const Entry& entry : entries) {
    const ButcherTablePointer table = load(entry.name);
    list.push_back({entry.name, table->q, table->p, table->stages - n_free, entry.note});
  }
  return list;
}

// Stages one after the other; none depends on a later one.
Complex stability(const ARKodeButcherTableMem& table, Complex z) {
  std::vector<Complex> stages(static_cast<std::size_t>(table.stages));
  Complex end = 1.0;
  for (int i = 0; i < table.stages; ++i) {
    Complex sum = 1.0;
    for (int j = 0; j < i; ++j) sum += z * table.A[i][j] * stages[static_cast<std::size_t>(j)];
    stages[static_cast<std::size_t>(i)] = sum / (1.0 - z * table.A[i][i]);
    end += z * table.b[i] * stages[static_cast<std::size_t>(i)];
  }
  return end;
}

}  // namespace

const std::vector<CoefficientTable>& explicit_tables() {
  static const std::vector<CoefficientTable> tables =
      list(explicit_entries, load_explicit_table, 1);
  return tables;
}

const std::vector<CoefficientTable>& dirk_tables() {
  static const std::vector<CoefficientTable> tables = list(implicit_entries, load_dirk_table, 0);
  return tables;
}

ButcherTablePointer load_explicit_table(const std::string& name) {
  const ExplicitEntry& entry = find(explicit_entries, name);
  ButcherTablePointer table = entry.id == ARKODE_ERK_NONE
                                  ? dop853()
                                  : checked(ARKodeButcherTable_LoadERK(entry.id), entry.name);
  return ends_with_next_first(*table) ? std::move(table) : with_end_as_last_stage(*table);
}

ButcherTablePointer load_dirk_table(const std::string& name) {
  const ImplicitEntry& entry = find(implicit_entries, name);
  return checked(ARKodeButcherTable_LoadDIRK(entry.id), entry.name);
}

Complex explicit_stability(const std::string& table, Complex z) {
  return stability(*load_explicit_table(table), z);
}

Complex dirk_stability(const std::string& table, Complex z) {
  return stability(*load_dirk_table(table), z);
}

}  // namespace subimpact
