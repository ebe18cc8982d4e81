#include "subimpact/study/forecast.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

#include "simulate/methods.h"
#include "study/refinement.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

// Counted work of a level that is made for a forecast, at most: some 0.3 s.
constexpr double affordable = 2e8;
// Of a level over that of its judged run.
constexpr double with_others = 2.4;
// Bytes of its model, at most.
constexpr double affordable_memory = 40e6;
// Evaluations in a step of a method that is not central differences, roughly.
constexpr double evaluations_per_step = 10.0;
// Uncertain sub-impacts become fewer as errors of this order do, at most.
constexpr int order_of_doubt = 2;

// What the program takes beside its runs, to start, to read, to sum its files and make them safe,
// and for the text of a row of a shape, measured on scenes of validation/run_cost.
constexpr double seconds_beside = 15e-3;
constexpr double wall_beside = 50e-3;
constexpr double seconds_per_row = 0.4e-6;
// With its libraries, its files and what earlier runs leave in its heap.
constexpr double memory_beside = 28e6;
constexpr double memory_of_program = 12e6;  // within ResolvedSettings::memory

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Ends a run that takes more than is affordable, wherever it then is.
class StepLimit final : public Observer {
 public:
  StepLimit(const Case& input, const ResolvedSettings& used) {
    const bool is_one = input.solver.method == Method::central_difference;
    const auto unknowns = static_cast<double>(std::max<std::size_t>(used.n_unknowns, 1));
    left_ = affordable / with_others / unknowns / (is_one ? 1.0 : evaluations_per_step);
  }
  void on_step(const RunView&) override { left_ -= 1.0; }
  bool goes_on() const override { return left_ > 0.0; }

 private:
  double left_;
};

// Rows as they are made, to be counted alone.
class CountedRows final : public RowSink {
 public:
  void add(const HistoryRow&) override { n_ += 2; }  // twice as long
  void add(const SectionRow&) override { ++n_; }
  void add(const PointRow&) override { ++n_; }
  void add(const ShapeRow&) override { ++n_; }
  double seconds() const { return seconds_per_row * static_cast<double>(n_); }

 private:
  long n_ = 0;
};

// A run that was made for the forecast, or as much of it as was affordable; what it takes to its
// end.
struct Sample {
  Case input;
  Result result;
  double steps = 0.0, decomposition = 0.0;  // counted work
  double seconds = 0.0;
  double memory = 0.0;  // bytes, of the model
  bool is_whole = false;

  double work() const { return steps + decomposition; }
};

double size_ratio(const Case& a, const Case& b) {
  return static_cast<double>(mesh_count(a)) / mesh_count(b);
}

bool are_of_one_kind(const Case& a, const Case& b) {
  return a.model.mesh == b.model.mesh && a.solver.method == b.solver.method;
}

bool are_same(const Case& a, const Case& b) {
  return are_of_one_kind(a, b) && mesh_count(a) == mesh_count(b) &&
         a.solver.rtol == b.solver.rtol && a.solver.step == b.solver.step &&
         a.output.interval == b.output.interval && a.output.shapes == b.output.shapes;
}

enum class Outlook {
  expected,
  next_suffices,  // the first level that is not made meets the tolerance
  none_is_certain
};

// Makes the runs of a search where they are affordable, and foresees them elsewhere.
class Forecaster {
 public:
  explicit Forecaster(Jobs jobs) : jobs_(jobs) {}

  // What a search takes whose runs are made here.
  template <class SearchWith>
  ForecastCost cost_of(Outlook outlook, SearchWith search) {
    outlook_ = outlook;
    cost_ = {{}, seconds_beside, wall_beside};
    last_.reset();
    in_runs_ = 0.0;
    const double begun = processor_seconds();
    search([this](const Case& input, const std::vector<CaseBeside>& cases, RowSink*, Result& run,
                  std::vector<RunBeside>& beside) { make(input, cases, run, beside); });
    besides_ = std::max(besides_, processor_seconds() - begun - in_runs_);
    add_alone(besides_);
    return std::move(cost_);
  }
  double memory() const { return memory_beside + memory_; }

 private:
  void make(const Case& input, const std::vector<CaseBeside>& cases, Result& run,
            std::vector<RunBeside>& beside);
  const Sample& sample_of(const Case& input, bool is_beside);
  const Sample* known(const Case& input) const;
  void begin(const Case& input, bool is_beside);
  void make_coarse(Case input);
  const Sample* finest_like(const Case& input) const;
  const Sample* half_of(const Sample& finest) const;
  Sample foreseen(const Case& input) const;
  Result result_of(const Sample& foreseen) const;
  void add(const Sample& run, bool is_beside);
  void add_alone(double seconds);

  Jobs jobs_;
  Outlook outlook_ = Outlook::expected;
  std::deque<Sample> samples_;
  std::optional<Case> last_;  // whose run was judged last
  Result like_;               // of it
  ForecastCost cost_;
  double besides_ = 0.0;  // s, of what the search does itself and of what shear would change
  double judging_ = 0.0;  // s, of a level
  double in_runs_ = 0.0;  // s, that the forecast has spent on runs
  double memory_ = 0.0;   // bytes, of runs beside one another
};

const Sample* Forecaster::known(const Case& input) const {
  const auto is_same = [&](const Sample& sample) { return are_same(sample.input, input); };
  const auto found = std::ranges::find_if(samples_, is_same);
  return found == samples_.end() ? nullptr : &*found;
}

const Sample& Forecaster::sample_of(const Case& input, bool is_beside) {
  if (const Sample* const sample = known(input)) return *sample;
  const double begun = processor_seconds();
  ResolvedRun resolved = resolve(input);
  const ResolvedSettings& used = resolved.settings();
  Sample sample;
  sample.input = input;
  sample.decomposition = used.decomposition;
  sample.memory = used.memory - memory_of_program;
  // Natural modes of elements take twice what is stated while they are made.
  if (used.decomposition > 0.0 && input.model.mesh != MeshKind::cells) {
    sample.memory += sizeof(double) * std::pow(static_cast<double>(used.n_unknowns), 2);
  }
  const bool is_unknown = finest_like(input) == nullptr;
  StepLimit limit(input, used);
  CountedRows rows;
  NoRows none;
  sample.result = simulate(std::move(resolved), {}, is_unknown ? &limit : nullptr,
                           is_beside ? static_cast<RowSink*>(&none) : &rows);
  sample.is_whole = sample.result.outcome.kind != OutcomeKind::stopped;
  const double parts = sample.is_whole ? 1.0 : input.end_time / sample.result.outcome.time;
  sample.seconds = parts * (processor_seconds() - begun + rows.seconds());
  sample.steps = parts * (counted_work(sample.result) - sample.decomposition);
  samples_.push_back(std::move(sample));
  return samples_.back();
}

// Of a model that is too large to be made, those of coarser meshes.
void Forecaster::make_coarse(Case input) {
  const auto is_large = [](const Case& of) {
    const ResolvedSettings& used = resolve(of).settings();
    return used.memory > affordable_memory || used.decomposition > affordable;
  };
  const Case asked = input;
  while (is_large(input)) {
    const std::optional<RefinedRun> coarser = on_other_mesh(input, 0.5);
    if (!coarser) return;
    input = coarser->input;
  }
  if (mesh_count(input) == mesh_count(asked)) return;
  sample_of(input, true);
  if (const auto half = on_other_mesh(input, 0.5)) sample_of(half->input, true);
}

// Makes a run of the kind, if there is none.
void Forecaster::begin(const Case& input, bool is_beside) {
  if (finest_like(input) == nullptr) make_coarse(input);
  if (finest_like(input) == nullptr) sample_of(input, is_beside);
}

const Sample* Forecaster::finest_like(const Case& input) const {
  const Sample* finest = nullptr;
  for (const Sample& sample : samples_) {
    if (!are_of_one_kind(sample.input, input)) continue;
    if (finest == nullptr || size_ratio(sample.input, finest->input) > 1.0) finest = &sample;
  }
  return finest;
}

// A whole run on a mesh of about half the size.
const Sample* Forecaster::half_of(const Sample& finest) const {
  const Sample* half = nullptr;
  const auto distance = [&](const Sample& sample) {
    return std::abs(std::log2(size_ratio(finest.input, sample.input)) - 1.0);
  };
  for (const Sample& sample : samples_) {
    if (!finest.is_whole || !sample.is_whole || !are_of_one_kind(sample.input, finest.input) ||
        size_ratio(finest.input, sample.input) <= 1.0) {
      continue;
    }
    if (half == nullptr || distance(sample) < distance(*half)) half = &sample;
  }
  return half;
}

// Work grows as from a mesh of half the size to the finest that was made, and time with the work.
Sample Forecaster::foreseen(const Case& input) const {
  if (const Sample* const sample = known(input)) return *sample;
  const Sample& finest = *finest_like(input);
  const Sample* const half = half_of(finest);
  const double ratio = size_ratio(input, finest.input);
  const auto grown = [&](double Sample::*work, double usual) {
    double exponent = usual;
    if (half != nullptr && half->*work > 0.0) {
      exponent =
          std::log(finest.*work / half->*work) / std::log(size_ratio(finest.input, half->input));
    }
    return finest.*work * std::pow(ratio, std::clamp(exponent, 0.5, 4.0));
  };
  Sample run;
  run.input = input;
  run.steps = grown(&Sample::steps, usual_growth);
  run.decomposition = grown(&Sample::decomposition, 3.0);
  const double per_work = finest.seconds / finest.work();
  double slope = per_work;
  if (half != nullptr && finest.work() > half->work()) {
    slope = (finest.seconds - half->seconds) / (finest.work() - half->work());
  }
  run.seconds =
      finest.seconds + std::clamp(slope, 0.5 * per_work, per_work) * (run.work() - finest.work());
  run.memory = finest.memory * std::pow(ratio, finest.decomposition > 0.0 ? 2.0 : 1.0);
  return run;
}

// What the search takes for the result of a run: sub-impacts become certain, and then errors fall,
// with the order of the mesh.
Result Forecaster::result_of(const Sample& foreseen) const {
  Result run = like_;
  run.given = foreseen.input;
  run.outcome = {};
  run.outcome.time = foreseen.input.end_time;
  run.used.decomposition = 0.0;
  run.work = {};
  run.work.right_hand_sides = std::lround(
      foreseen.work() / static_cast<double>(std::max<std::size_t>(run.used.n_unknowns, 1)));
  if (outlook_ == Outlook::next_suffices) {
    run.error_estimate.emplace();
    for (SubImpact& s : run.sub_impacts) s.certain = true;
  }
  if (!run.error_estimate || !last_) return run;
  const int order = mesh_order(foreseen.input).value_or(0);
  const double ratio = size_ratio(foreseen.input, *last_);
  ErrorEstimate& estimate = *run.error_estimate;
  if (!estimate.first_unresolved) {
    estimate.largest_error *= std::pow(ratio, -order);
    return run;
  }
  if (outlook_ == Outlook::none_is_certain) return run;
  const std::size_t n = run.sub_impacts.size();
  const auto n_uncertain = static_cast<double>(std::max<std::size_t>(n - *run.n_certain(), 1));
  const double falls = std::pow(ratio, -std::min(order, order_of_doubt));
  const auto n_left = std::min(n, static_cast<std::size_t>(n_uncertain * falls));
  for (std::size_t i = 0; i < n; ++i) run.sub_impacts[i].certain = i + n_left < n;
  estimate.first_unresolved.reset();
  if (n_left > 0) estimate.first_unresolved = n - n_left;
  return run;
}

void Forecaster::add(const Sample& run, bool is_beside) {
  const bool is_next =
      last_ && !(are_of_one_kind(*last_, run.input) && mesh_count(*last_) == mesh_count(run.input));
  const int level = cost_.runs.empty() ? 1 : cost_.runs.back().level;
  cost_.runs.push_back({level + (is_next && !is_beside ? 1 : 0), is_beside, mesh_words(run.input),
                        descriptor_of(run.input.solver.method).name, run.seconds, run.memory,
                        run.is_whole});
  cost_.processor_seconds += run.seconds;
}

void Forecaster::add_alone(double seconds) {
  cost_.processor_seconds += seconds;
  cost_.wall_seconds += seconds;
}

void Forecaster::make(const Case& input, const std::vector<CaseBeside>& cases, Result& run,
                      std::vector<RunBeside>& beside) {
  const double begun = processor_seconds();
  const std::size_t first = cost_.runs.size();
  begin(input, false);
  const Sample expected = foreseen(input);
  const bool is_begun = known(input) != nullptr || (with_others * expected.work() <= affordable &&
                                                    expected.memory <= affordable_memory);
  bool is_made = is_begun && sample_of(input, false).is_whole;
  for (const CaseBeside& other : cases) is_made = is_made && sample_of(other.input, true).is_whole;
  if (is_made) {
    run = known(input)->result;
    add(*known(input), false);
    for (const CaseBeside& other : cases) {
      beside.push_back({other, known(other.input)->result});
      add(*known(other.input), true);
    }
    const double judged_from = processor_seconds();
    judge(input, run, beside);
    judging_ = processor_seconds() - judged_from;
  } else {
    if (is_begun || !last_) {
      like_ = finest_like(input)->result;
      like_.sub_impacts.clear();
      like_.error_estimate.reset();
    }
    const auto foresee = [&](const Case& of, bool is_beside) {
      begin(of, is_beside);
      const Sample foretold = foreseen(of);
      add(foretold, is_beside);
      return result_of(foretold);
    };
    run = foresee(input, false);
    for (const CaseBeside& other : cases) beside.push_back({other, foresee(other.input, true)});
  }
  last_ = input;
  like_ = run;
  std::vector<double> seconds, memory;
  for (std::size_t i = first; i < cost_.runs.size(); ++i) {
    seconds.push_back(cost_.runs[i].seconds);
    memory.push_back(cost_.runs[i].memory);
  }
  cost_.wall_seconds += wall_seconds(seconds, jobs_);
  add_alone(judging_);
  std::ranges::sort(memory, std::greater());
  memory.resize(std::min<std::size_t>(memory.size(), jobs_));
  memory_ = std::max(memory_, std::reduce(memory.begin(), memory.end()));
  in_runs_ += processor_seconds() - begun;
}

}  // namespace

double wall_seconds(const std::vector<double>& runs, Jobs jobs) {
  std::vector<double> busy(std::max(jobs, 1u), 0.0);
  for (const double run : runs) *std::ranges::min_element(busy) += run;
  return *std::ranges::max_element(busy);
}

RunForecast forecast(const Case& input, const GivenKeys& given, Jobs jobs,
                     const std::optional<ErrorBars>& error_bars) {
  RunForecast forecast;
  Case once = input;
  once.strikes = 1;
  forecast.first = first_run(once, given);
  forecast.jobs = std::max(jobs, 1u);
  Forecaster forecaster(forecast.jobs);
  forecast.expected = forecaster.cost_of(Outlook::expected, [&](const JudgedRunMaker& make) {
    RunRequest request;
    request.make = make;
    request.error_bars = error_bars;
    run_as_asked(once, given, std::move(request));
  });
  const auto open = choices_left(input, given, error_bars);
  const auto search = [&](const JudgedRunMaker& make) {
    WithinOptions options;
    options.make = make;
    simulate_within(once, *open, options);
  };
  forecast.least = open ? forecaster.cost_of(Outlook::next_suffices, search) : forecast.expected;
  forecast.most = open ? forecaster.cost_of(Outlook::none_is_certain, search) : forecast.expected;
  forecast.memory = forecaster.memory();
  return forecast;
}

}  // namespace subimpact
