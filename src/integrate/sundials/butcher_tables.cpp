#include "integrate/sundials/butcher_tables.h"

#include <arkode/arkode_butcher_erk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "integrate/arkode_erk.h"

namespace subimpact {
namespace {

struct Entry {
  CoefficientTable table;
  int sundials_id;  // ARKODE_ERK_NONE: built here
};

// clang-format off
const std::vector<Entry>& entries_of_tables() {
  static const std::vector<Entry> entries = {
      {{"dop853", 8, 5, 12, "Hairer, Norsett and Wanner, 8(5): fewest evaluations on an elastic beam"}, ARKODE_ERK_NONE},
      {{"dormand-prince", 5, 4, 6, "Dormand and Prince 1980, 5(4): sound at every accuracy"}, ARKODE_DORMAND_PRINCE_7_4_5},
      {{"bogacki-shampine", 3, 2, 3, "Bogacki and Shampine 1989, 3(2): low accuracy"}, ARKODE_BOGACKI_SHAMPINE_4_2_3},
      {{"zonneveld", 4, 3, 5, "Zonneveld 1963, 4(3)"}, ARKODE_ZONNEVELD_5_3_4},
      {{"cash-karp", 5, 4, 6, "Cash and Karp 1990, 5(4): the energy grows at every step, however short; for studies of that"}, ARKODE_CASH_KARP_6_4_5},
      {{"verner", 6, 5, 8, "Verner 1978, 6(5)"}, ARKODE_VERNER_8_5_6},
      {{"fehlberg-78", 8, 7, 13, "Fehlberg 1968, 8(7)"}, ARKODE_FEHLBERG_13_7_8},
  };
  return entries;
}
// clang-format on

// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.10: the
// order-8 method of DOP853 with its error estimator of order 5 as the embedded method (b_embedded =
// b - er).
ButcherTablePointer dop853() {
  constexpr int n = 12;
  ButcherTablePointer table(ARKodeButcherTable_Alloc(n, SUNTRUE));
  if (!table) throw std::runtime_error("ARKodeButcherTable_Alloc failed");
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

// Appends the step's end as a last stage. Nothing is lost: that evaluation is the next step's
// first.
ButcherTablePointer with_end_as_last_stage(const ARKodeButcherTableMem& from) {
  const int n = from.stages;
  ButcherTablePointer table(ARKodeButcherTable_Alloc(n + 1, SUNTRUE));
  if (!table) throw std::runtime_error("ARKodeButcherTable_Alloc failed");
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

}  // namespace

const std::vector<CoefficientTable>& explicit_tables() {
  static const std::vector<CoefficientTable> tables = [] {
    std::vector<CoefficientTable> list;
    for (const Entry& entry : entries_of_tables()) list.push_back(entry.table);
    return list;
  }();
  return tables;
}

ButcherTablePointer load_explicit_table(const std::string& name) {
  for (const Entry& entry : entries_of_tables()) {
    if (!name.empty() && entry.table.name != name) continue;
    ButcherTablePointer table = entry.sundials_id == ARKODE_ERK_NONE
                                    ? dop853()
                                    : ButcherTablePointer(ARKodeButcherTable_LoadERK(
                                          static_cast<ARKODE_ERKTableID>(entry.sundials_id)));
    if (!table) throw std::runtime_error("SUNDIALS has no table " + name);
    return ends_with_next_first(*table) ? std::move(table) : with_end_as_last_stage(*table);
  }
  throw std::invalid_argument("unknown explicit Runge-Kutta table '" + name + "'");
}

}  // namespace subimpact
