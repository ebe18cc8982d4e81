#include "integrate/nystrom.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "numerics/vector_sum.h"

namespace subimpact {
namespace {

// Step control: the next step is `safety` of what the estimate allows, changed by limited factors.
constexpr double safety = 0.9;
constexpr double largest_growth = 4.0;
constexpr double largest_cut = 0.2;
constexpr double integral_part = 0.4;
constexpr int most_rejections = 40;
// A step shorter than this part of the time it starts at advances by little but rounding.
constexpr double shortest_step = 16.0 * std::numeric_limits<double>::epsilon();

// Adds factor * sum_j row[j] stages[j] over the first `length` stages.
void add_stages(VectorSum& sum, const std::vector<double>& row, std::size_t length,
                const std::vector<AlignedVector>& stages, double factor) {
  assert(row.size() >= length && stages.size() >= length);
  for (std::size_t j = 0; j < length; ++j) sum.add(factor * row[j], stages[j].data());
}

// Dormand, El-Mikkawy and Prince 1987, High-order embedded Runge-Kutta-Nystroem formulae, IMA J.
// Numer. Anal. 7, 423-430: RKN8(6)9FM.
// clang-format off
NystromTable dprkn8() {
  NystromTable t;
  t.name = "dprkn8";
  t.note = "Dormand, El-Mikkawy and Prince 1987, RKN8(6): the default";
  t.order = 8;
  t.embedded_order = 6;
  t.c = {0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 1.0};
  t.a = {
      {},
      {0.00125},
      {1.6666666666666666667e-3, 3.3333333333333333333e-3},
      {0.045, -0.09, 0.09},
      {-3.3797985325712432608e-1, 8.6115164781709838259e-1, -4.8613644655235315578e-1,
          8.7964651992379099274e-2},
      {7.4614626410430861361e-1, -1.8043474302467370691, 1.2761518285888953529,
          -3.1220932716737167667e-2, 5.8270270270270270270e-2},
      {-1.2551623461807584701, 3.2574631870648233678, -2.0688666195750890729,
          4.2064784556032508713e-1, -1.8382978723404255319e-2, 6.9300911854103343465e-2},
      {3.7729018300959411123, -9.6696131216771943946, 6.7991544547851672739,
          -8.4903439078238932798e-1, 4.6717348654708520179e-1, -4.9397421524663677130e-2,
          2.8815162556053811659e-2},
      {2.8092718568909045100e-2, 0.0, 1.4570932539682539683e-1, 1.5294312169312169312e-1,
          9.1517857142857142857e-2, 6.5547052154195011338e-2, 1.6189925044091710758e-2, 0.0},
  };
  t.position = {2.8092718568909045100e-2, 0.0, 1.4570932539682539683e-1,
      1.5294312169312169312e-1, 9.1517857142857142857e-2, 6.5547052154195011338e-2,
      1.6189925044091710758e-2, 0.0, 0.0};
  t.velocity = {2.8092718568909045100e-2, 0.0, 1.6189925044091710758e-1,
      2.1849017384731670446e-1, 1.8303571428571428571e-1, 2.1849017384731670446e-1,
      1.6189925044091710758e-1, 2.8092718568909045100e-2, 0.0};
  t.position_error = {-4.4557986852984274335e-2, 0.0, 1.0965442077101598762e-1,
      -1.4620589436135465016e-1, 1.3158530492521918515e-1, -6.2659669012009135784e-2,
      1.2183824530112887514e-2, 0.0, 0.0};
  t.velocity_error = {-4.4557986852984274335e-2, 0.0, 1.2183824530112887514e-1,
      -2.0886556337336378595e-1, 2.6317060985043837029e-1, -2.0886556337336378595e-1,
      1.2183824530112887514e-1, 1.0544201314701572566e-1, -0.15};
  return t;
}
// clang-format on

// Dormand, El-Mikkawy and Prince 1987, as above: RKN12(10)17M.
// clang-format off
NystromTable dprkn12() {
  NystromTable t;
  t.name = "dprkn12";
  t.note = "Dormand, El-Mikkawy and Prince 1987, RKN12(10): smooth problems to rounding";
  t.order = 12;
  t.embedded_order = 10;
  t.c = {0.0, 0.02, 0.04, 0.1, 1.3333333333333333333e-1, 0.16, 0.05, 0.2, 0.25,
      3.3333333333333333333e-1, 0.5, 5.5555555555555555556e-1, 0.75, 8.5714285714285714286e-1,
      9.4521622227201434013e-1, 1.0, 1.0};
  t.a = {
      {},
      {0.0002},
      {2.6666666666666666667e-4, 5.3333333333333333333e-4},
      {2.9166666666666666667e-3, -4.1666666666666666667e-3, 0.00625},
      {1.6460905349794238683e-3, 0.0, 5.4869684499314128944e-3, 1.7558299039780521262e-3},
      {0.0019456, 0.0, 7.1517460317460317460e-3, 2.9127111111111111111e-3,
          7.8994285714285714286e-4},
      {5.6640625000000000000e-4, 0.0, 8.8097304894179894180e-4, -4.3692129629629629630e-4,
          3.3900669642857142857e-4, -9.9464699074074074074e-5},
      {3.0833333333333333333e-3, 0.0, 0.0, 1.7777777777777777778e-3, 0.0027,
          1.5782828282828282828e-3, 1.0860606060606060606e-2},
      {3.6518393748011297138e-3, 0.0, 3.9651717140723430662e-3, 3.1972582629306282235e-3,
          8.2214673068554353697e-3, -1.3130926959572379836e-3, 9.7715869680648678156e-3,
          3.7557690692328337949e-3},
      {3.7072410687185008102e-3, 0.0, 5.0820458545552859808e-3, 1.1747080021754120447e-3,
          -2.1147629915126991500e-2, 6.0104636981078808122e-2, 2.0105734768506188185e-2,
          -2.8350750122933580843e-2, 1.4879568918581932756e-2},
      {3.5125376560733441531e-2, 0.0, -8.6157491951384791034e-3, -5.7914480510079165217e-3,
          1.9455548237826158424, -3.4351238674565135964, -1.0930701107475221758e-1,
          2.3496383118995166394, -7.5600940868702297803e-1, 1.0952897222156926425e-1},
      {2.0527792537482496651e-2, 0.0, -7.2864467644801799178e-3, -2.1153556079618402407e-3,
          9.2758079687235222426e-1, -1.6522824844257366791, -2.1079563005686569819e-2,
          1.2065364326207871545, -4.1371447700106614132e-1, 9.0798739828096537596e-2,
          5.3555526005339850492e-3},
      {-1.4324078875545515046e-1, 0.0, 1.2528703773091817278e-2, 6.8260191639698271287e-3,
          -4.7995553955743872655, 5.6986250439519414338, 7.5534303695236452225e-1,
          -1.2755487858281083718e-1, -1.9605926051117384329, 9.1856090566352624098e-1,
          -2.3880085505284431053e-1, 1.5911081357234215514e-1},
      {8.0450192055204894870e-1, 0.0, -1.6658527067011245178e-2, -2.1415834042629734812e-2,
          1.6827235928962465870e+1, -1.1172835357176097927e+1, -3.3771592972263237415,
          -1.5243326655360845646e+1, 1.7179835738215416562e+1, -5.4377192398239946454,
          1.3878671618364655755, -5.9258277326528116535e-1, 2.9603873171297352796e-2},
      {-9.1329676669735808210e-1, 0.0, 2.4112725757805178392e-3, 1.7658122693861741982e-2,
          -1.4851649779720383825e+1, 2.1589708670045756003, 3.9979155831178799012,
          2.8434151800232231898e+1, -2.5259364354941598438e+1, 7.7338785423622373655,
          -1.8913028948478674610, 1.0014845070224717804, 4.6411995991090519051e-3,
          1.1218755022148957034e-2},
      {-2.7519629720559393821e-1, 0.0, 3.6611888779154920134e-2, 9.7895196882315626247e-3,
          -1.2293062345886210304e+1, 1.4207226453937902694e+1, 1.5866476906789536832,
          2.4577735327595945439, -8.9351936944032719055, 4.3736727316134069484,
          -1.8347181765449491630, 1.1592085289061491208, -1.7290253165383922152e-2,
          1.9325977904460766673e-2, 5.2044429375549931118e-3},
      {1.3076391847404057588, 0.0, 1.7364109189745841867e-2, -1.8544456454265795024e-2,
          1.4811522032867726897e+1, 9.3831763084824709079, -5.2284261999445422541,
          -4.8951280525847650804e+1, 3.8297096034337922563e+1, -1.0587381336975979709e+1,
          2.4332304376226276359, -1.0453406042575444285, 7.1773209508672594520e-2,
          2.1622109708082782691e-3, 7.0095957596025142370e-3, 0.0},
  };
  t.position = {1.2127868517185414977e-2, 0.0, 0.0, 0.0, 0.0, 0.0, 8.6297462515688744436e-2,
      2.5254695811871471943e-1, -1.9741867993268230336e-1, 2.0318691907897259081e-1,
      -2.0775808077714916612e-2, 1.0967804874502013625e-1, 3.8065132526466505734e-2,
      1.1634068804324229644e-2, 4.6580297040248786869e-3, 0.0, 0.0};
  t.velocity = {1.2127868517185414977e-2, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0839434227040783617e-2,
      3.1568369764839339929e-1, -2.6322490657690973781e-1, 3.0478037861845888621e-1,
      -4.1551616155429833224e-2, 2.4677560967629530656e-1, 1.5226053010586602294e-1,
      8.1438481630269607509e-2, 8.5025711938908112801e-2, -9.1551896300779628731e-3, 0.025};
  t.position_error = {-4.8808333898215767759e-3, 0.0, 0.0, 0.0, 0.0, 0.0,
      1.4038126584857337488e-2, -1.1947921920803832596e-1, 2.0440246507662121808e-1,
      -1.3226814922237907589e-1, 1.1053069299761689182e-1, -7.9753857871028516473e-2,
      1.1224330486437457829e-2, -4.6715968015936942494e-3, 8.5804134732828412527e-4, 0.0, 0.0};
  t.velocity_error = {-4.8808333898215767759e-3, 0.0, 0.0, 0.0, 0.0, 0.0,
      1.4776975352481407882e-2, -1.4934902401004790744e-1, 2.7253662010216162411e-1,
      -1.9840222383356861383e-1, 2.2106138599523378364e-1, -1.7944618020981416206e-1,
      4.4897321945749831316e-2, -3.2701177611155859746e-2, 1.5662325288859435792e-2,
      -2.9155189630077962873e-2, 0.025};
  return t;
}
// clang-format on

}  // namespace

bool NystromTable::first_same_as_last() const {
  const std::size_t last = c.size() - 1;
  if (c[last] != 1.0 || position[last] != 0.0) return false;
  for (std::size_t j = 0; j < last; ++j) {
    if (a[last][j] != position[j]) return false;
  }
  return true;
}

const std::vector<NystromTable>& nystrom_tables() {
  static const std::vector<NystromTable> tables = [] {
    std::vector<NystromTable> list = {dprkn8(), dprkn12()};
    for (NystromTable& table : list) {
      table.evaluations = static_cast<int>(table.n_stages()) - (table.first_same_as_last() ? 1 : 0);
    }
    return list;
  }();
  return tables;
}

const NystromTable& nystrom_table(const std::string& name) {
  for (const NystromTable& table : nystrom_tables()) {
    if (name.empty() || table.name == name) return table;
  }
  throw std::invalid_argument("unknown Runge-Kutta-Nystroem table '" + name + "'");
}

Nystrom::Nystrom(SecondOrderOde& ode, const IntegratorOptions& options)
    : ode_(ode),
      table_(nystrom_table(options.table)),
      first_same_as_last_(table_.first_same_as_last()),
      n_(ode.n_positions()),
      fixed_step_(options.fixed_step),
      max_step_(options.max_step.value_or(std::numeric_limits<double>::infinity())),
      position_weight_(1.0 / (options.relative_tolerance * ode.scales().position)),
      velocity_weight_(1.0 / (options.relative_tolerance * ode.scales().velocity)),
      stages_(table_.n_stages(), Vector(n_)),
      partial_stages_(table_.n_stages(), Vector(n_)),
      end_acceleration_(n_) {
  // A first guess the controller corrects at once: a thousandth of the problem's own time scale.
  next_step_ = fixed_step_.value_or(1e-3 * ode.scales().position / ode.scales().velocity);
}

void Nystrom::accelerate(double t, const double* positions, Vector& result) {
  ode_.set_time(t);
  ode_.acceleration({positions, n_}, result);
  ++work_.right_hand_sides;
}

void Nystrom::restart(double t, const State& y) {
  stand_at(t, y);
  accelerate(t, y1_.data(), end_acceleration_);
}

void Nystrom::advance(double h, std::vector<Vector>& stages, State& y) {
  const double* q0 = y0_.data();
  const double* v0 = q0 + n_;
  double* q = y.data();
  // q0 + time v0 + h^2 sum_j row[j] k_j
  const auto write_position = [&](double time, const std::vector<double>& row, std::size_t length) {
    VectorSum position;
    position.add(1.0, q0);
    position.add(time, v0);
    add_stages(position, row, length, stages, h * h);
    position.write(q, n_);
  };
  const std::size_t n_inner = table_.n_stages() - (first_same_as_last_ ? 1 : 0);
  for (std::size_t i = 1; i < n_inner; ++i) {
    write_position(table_.c[i] * h, table_.a[i], i);
    accelerate(t0_ + table_.c[i] * h, q, stages[i]);
  }
  write_position(h, table_.position, n_inner);
  if (first_same_as_last_ && &stages == &stages_) accelerate(t0_ + h, q, stages.back());
  // The velocity weights of a table that ends on the next step's first stage leave that stage out.
  VectorSum velocity;
  velocity.add(1.0, v0);
  add_stages(velocity, table_.velocity, n_inner, stages, h);
  velocity.write(q + n_, n_);
}

double Nystrom::error_norm(double h) const {
  const std::size_t n_stages = table_.n_stages();
  VectorSum position, velocity;
  add_stages(position, table_.position_error, n_stages, stages_, h * h * position_weight_);
  add_stages(velocity, table_.velocity_error, n_stages, stages_, h * velocity_weight_);
  const double sum = position.sum_of_squares(n_) + velocity.sum_of_squares(n_);
  return std::sqrt(sum / static_cast<double>(2 * n_));
}

void Nystrom::step() {
  std::swap(y0_, y1_);
  std::swap(stages_.front(), end_acceleration_);
  t0_ = t1_;
  y1_.resize(y0_.size());
  for (int rejections = 0;; ++rejections) {
    const double h = std::min(next_step_, max_step_);
    const bool too_short = !fixed_step_ && !(h > shortest_step * std::abs(t0_));
    if (too_short || rejections > most_rejections) {
      undo_step();
      throw IntegrationFailure(t0_, "nystrom", "step size too small",
                               "the error estimate stays above the tolerance, or is not a number, "
                               "however short the step");
    }
    advance(h, stages_, y1_);
    t1_ = t0_ + h;
    if (fixed_step_) break;
    const double error = error_norm(h);
    const double exponent = 1.0 / (table_.embedded_order + 1.0);
    if (error <= 1.0) {
      const double now = std::max(error, 1e-10);
      const double factor = safety * std::pow(now, -exponent * (1.0 + integral_part)) *
                            std::pow(previous_error_, exponent * integral_part);
      next_step_ = h * std::clamp(factor, largest_cut, rejections > 0 ? 1.0 : largest_growth);
      previous_error_ = now;
      break;
    }
    ++work_.rejected_steps;
    const double factor = std::isfinite(error) ? safety * std::pow(error, -exponent) : largest_cut;
    next_step_ = h * std::max(factor, largest_cut);
  }
  if (first_same_as_last_) {
    std::copy(stages_.back().begin(), stages_.back().end(), end_acceleration_.begin());
  } else {
    accelerate(t1_, y1_.data(), end_acceleration_);
  }
  ++work_.steps;
}

void Nystrom::state_at(double t, State& y) {
  y.resize(2 * n_);
  std::swap(partial_stages_.front(), stages_.front());
  advance(t - t0_, partial_stages_, y);
  std::swap(partial_stages_.front(), stages_.front());
  ++work_.partial_steps;
}

}  // namespace subimpact
