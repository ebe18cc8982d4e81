#include "subimpact/study/forecast.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

#include "simulate/settings/methods.h"
#include "study/parallel.h"
#include "study/refinement/refinement.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/sensitivity/predictability.h"

namespace subimpact {
namespace {

// Counted work of a level that is made for a forecast, at most: some 0.3 s.
constexpr double affordable = 2e8;
// Bytes of its model, at most.
constexpr double affordable_memory = 40e6;
// Evaluations in a step of a method that is not central differences, roughly.
constexpr double evaluations_per_step = 10.0;
// Uncertain sub-impacts become fewer as errors of this order do, at most.
constexpr int order_of_doubt = 2;

// What the program takes beside its runs, to start, to read, to sum its files and make them safe,
// and for the text of a row of a shape, measured on scenes of validation/cost/run_cost.
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
struct StepLimit final : Observer {
  explicit StepLimit(double most) : left(most) {}
  void on_step(const RunView&) override { left -= 1.0; }
  bool goes_on() const override { return left > 0.0; }
  double left;
};

// Has all rows made, and keeps none.
struct AllRows final : RowSink {
  void add(const HistoryRow&) override {}
  void add(const SectionRow&) override {}
};

// A run made for the forecast, to its end or as far as was affordable; costs are those of the
// whole.
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

enum class Assumption {
  expected,
  next_suffices,  // the first level that is not made meets the tolerance
  none_is_certain
};

// Makes the runs of a search where they are affordable, and extrapolates them elsewhere.
class Forecaster {
 public:
  explicit Forecaster(Jobs jobs) : jobs_(jobs) {}

  // What a search takes whose runs are made here.
  template <class SearchWith>
  ForecastCost cost_of(Assumption assumption, SearchWith search) {
    assumption_ = assumption;
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
  void add_scatter(double n_runs, ForecastCost& cost) const;

 private:
  void make(const Case& input, const std::vector<CaseBeside>& cases, Result& run,
            std::vector<RunBeside>& beside);
  const Sample* known(const Case& input) const;
  const Sample* nearest(const Case& kind, double size, const Sample* but = nullptr) const;
  const Sample* finest(const Case& kind) const { return nearest(kind, HUGE_VAL); }
  const Sample& sample_of(const Case& input, bool is_beside);
  void begin(Case input, bool is_beside);
  Sample extrapolated(const Case& input) const;
  Result result_of(const Sample& extrapolated) const;
  void add_alone(double seconds) {
    cost_.processor_seconds += seconds;
    cost_.wall_seconds += seconds;
  }

  Jobs jobs_;
  Assumption assumption_ = Assumption::expected;
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

// The run of the kind on a mesh nearest to one of so many parts.
const Sample* Forecaster::nearest(const Case& kind, double size, const Sample* but) const {
  const auto is_nearer = [&](const Sample& a, const Sample& b) {
    const int n = mesh_count(a.input), m = mesh_count(b.input);
    return std::isinf(size) ? n > m : std::abs(std::log(n / size)) < std::abs(std::log(m / size));
  };
  const Sample* best = nullptr;
  for (const Sample& sample : samples_) {
    if (!are_of_one_kind(sample.input, kind) || &sample == but) continue;
    if (best == nullptr || is_nearer(sample, *best)) best = &sample;
  }
  return best;
}

const Sample& Forecaster::sample_of(const Case& input, bool is_beside) {
  if (const Sample* const sample = known(input)) return *sample;
  const double begun = processor_seconds();
  ResolvedRun resolved = resolve(input);
  const ResolvedSettings& used = resolved.settings();
  const auto unknowns = static_cast<double>(std::max<std::size_t>(used.n_unknowns, 1));
  Sample sample{input, {}, 0.0, used.decomposition, 0.0, used.memory - memory_of_program, false};
  // Natural modes may take another matrix, which is not stated.
  if (used.decomposition > 0.0) sample.memory += sizeof(double) * unknowns * unknowns;
  const bool is_one = input.solver.method == Method::central_difference;
  StepLimit limit(affordable / work_with_others / unknowns / evaluation_cost(input) /
                  (is_one ? 1.0 : evaluations_per_step));
  AllRows all;
  NoRows none;
  sample.result = simulate(std::move(resolved), {}, finest(input) == nullptr ? &limit : nullptr,
                           is_beside ? static_cast<RowSink*>(&none) : &all);
  const Result& result = sample.result;
  sample.is_whole = result.outcome.kind != OutcomeKind::stopped;
  const double parts = sample.is_whole ? 1.0 : input.end_time / result.outcome.time;
  sample.seconds = processor_seconds() - begun;
  if (!is_beside) {
    sample.seconds +=
        seconds_per_row * static_cast<double>(result.n_shape_rows + 2 * result.n_history_rows);
  }
  sample.seconds *= parts;
  sample.steps = parts * (counted_work(input, result) - sample.decomposition);
  samples_.push_back(std::move(sample));
  return samples_.back();
}

// Makes a run of the kind if there is none: of a model that is too large, on coarser meshes.
void Forecaster::begin(Case input, bool is_beside) {
  if (finest(input) != nullptr) return;
  const auto is_large = [](const Case& of) {
    const ResolvedRun run = resolve(of);
    return run.settings().memory > affordable_memory || run.settings().decomposition > affordable;
  };
  bool is_coarser = false;
  while (is_large(input)) {
    const std::optional<RefinedRun> half = on_other_mesh(input, 0.5);
    if (!half) break;
    input = half->input;
    is_coarser = true;
  }
  sample_of(input, is_beside || is_coarser);
  if (!is_coarser) return;
  if (const std::optional<RefinedRun> half = on_other_mesh(input, 0.5)) {
    sample_of(half->input, true);
  }
}

// Work grows as from a mesh of half the size to the finest that was made, and time with the work.
Sample Forecaster::extrapolated(const Case& input) const {
  if (const Sample* const sample = known(input)) return *sample;
  const Sample& finest = *this->finest(input);
  const Sample* half = nearest(input, 0.5 * mesh_count(finest.input), &finest);
  if (half != nullptr && size_ratio(finest.input, half->input) <= 1.0) half = nullptr;
  const double ratio = size_ratio(input, finest.input);
  const auto grown = [&](double Sample::*work, double exponent) {
    if (half != nullptr && half->*work > 0.0) {
      exponent =
          std::log(finest.*work / half->*work) / std::log(size_ratio(finest.input, half->input));
    }
    return finest.*work * std::pow(ratio, std::clamp(exponent, 0.5, 4.0));
  };
  Sample run{input, {}, grown(&Sample::steps, usual_growth), grown(&Sample::decomposition, 3.0)};
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
Result Forecaster::result_of(const Sample& extrapolated) const {
  Result run = like_;
  run.given = extrapolated.input;
  run.outcome = {};
  run.outcome.time = extrapolated.input.end_time;
  run.work = {};
  run.used.decomposition = extrapolated.work();  // which counted_work() takes as it is
  const std::size_t n = run.sub_impacts.size();
  std::size_t n_left = 0;
  if (assumption_ == Assumption::next_suffices) {
    run.error_estimate.emplace();
  } else if (!run.error_estimate || !last_) {
    return run;
  } else {
    const int order = mesh_order(extrapolated.input).value_or(0);
    const double ratio = size_ratio(extrapolated.input, *last_);
    if (run.all_certain()) run.error_estimate->largest_error *= std::pow(ratio, -order);
    if (run.all_certain() || assumption_ == Assumption::none_is_certain) return run;
    const auto n_uncertain = static_cast<double>(std::max<std::size_t>(n - *run.n_certain(), 1));
    n_left = std::min(n, static_cast<std::size_t>(
                             n_uncertain * std::pow(ratio, -std::min(order, order_of_doubt))));
  }
  for (std::size_t i = 0; i < n; ++i) run.sub_impacts[i].certain = i + n_left < n;
  run.error_estimate->first_unresolved.reset();
  if (n_left > 0) run.error_estimate->first_unresolved = n - n_left;
  return run;
}

void Forecaster::make(const Case& input, const std::vector<CaseBeside>& cases, Result& run,
                      std::vector<RunBeside>& beside) {
  const double begun = processor_seconds();
  begin(input, false);
  const Sample expected = extrapolated(input);
  const bool is_begun =
      known(input) != nullptr ||
      (work_with_others * expected.work() <= affordable && expected.memory <= affordable_memory);
  bool is_made = is_begun && sample_of(input, false).is_whole;
  for (const CaseBeside& other : cases) is_made = is_made && sample_of(other.input, true).is_whole;
  if (!is_made && (is_begun || !last_)) {
    like_ = finest(input)->result;
    like_.sub_impacts.clear();
    like_.error_estimate.reset();
  }
  const bool is_next =
      last_ && !(are_of_one_kind(*last_, input) && size_ratio(*last_, input) == 1.0);
  const int level = cost_.runs.empty() ? 1 : cost_.runs.back().level + (is_next ? 1 : 0);
  std::vector<double> seconds, memory;
  const auto take = [&](const Case& of, const std::string& difference) {
    const bool is_beside = !difference.empty();
    begin(of, is_beside);
    const Sample sample = extrapolated(of);
    std::string mesh = mesh_words(of);
    if (!mesh.starts_with(difference)) mesh += ", " + difference;
    cost_.runs.push_back({level, is_beside, mesh, descriptor_of(of.solver.method).name,
                          sample.work(), sample.seconds, sample.is_whole});
    cost_.processor_seconds += sample.seconds;
    seconds.push_back(sample.seconds);
    memory.push_back(sample.memory);
    return is_made ? sample.result : result_of(sample);
  };
  run = take(input, {});
  for (const CaseBeside& other : cases) {
    beside.push_back({other, take(other.input, other.description)});
  }
  if (is_made) {
    const double from = processor_seconds();
    judge(input, run, beside);
    judging_ = processor_seconds() - from;
  }
  last_ = input;
  like_ = run;
  cost_.wall_seconds += wall_seconds(seconds, jobs_);
  add_alone(judging_);
  std::ranges::sort(memory, std::greater());
  memory.resize(std::min<std::size_t>(memory.size(), jobs_));
  memory_ = std::max(memory_, std::reduce(memory.begin(), memory.end()));
  in_runs_ += processor_seconds() - begun;
}

// Of runs on the last mesh of a search, or on a coarser one where these would be above the limit.
void Forecaster::add_scatter(double n_runs, ForecastCost& cost) const {
  const Sample& finest = *this->finest(*last_);
  ForecastRun runs = cost.runs.back();
  runs.work = std::min(n_runs * runs.work, most_work_of_scatter);
  runs.seconds = runs.work * finest.seconds / finest.work();
  runs.is_made = false;
  runs.n_runs = static_cast<int>(n_runs);
  cost.processor_seconds += runs.seconds;
  cost.wall_seconds += runs.seconds / jobs_;
  cost.runs.push_back(std::move(runs));
}

}  // namespace

RunForecast forecast(const Case& input, const GivenKeys& given, Jobs jobs) {
  RunForecast forecast;
  Case once = input;
  once.strikes = 1;
  forecast.first = first_run(once, given);
  forecast.first.input.strikes = input.strikes;
  forecast.jobs = std::max(jobs, 1u);
  Forecaster forecaster(forecast.jobs);
  forecast.expected = forecaster.cost_of(Assumption::expected, [&](const JudgedRunMaker& make) {
    RunRequest request;
    request.make = make;
    run_as_asked(once, given, std::move(request));
  });
  const auto open = choices_left(input, given, std::nullopt);
  const auto search = [&](const JudgedRunMaker& make) {
    WithinOptions options;
    options.make = make;
    simulate_within(once, *open, options);
  };
  forecast.least = open ? forecaster.cost_of(Assumption::next_suffices, search) : forecast.expected;
  forecast.most =
      open ? forecaster.cost_of(Assumption::none_is_certain, search) : forecast.expected;
  if (const auto n_keys = static_cast<double>(scattering_keys(once).size()); n_keys > 0.0) {
    for (ForecastCost* cost : {&forecast.expected, &forecast.least, &forecast.most}) {
      forecaster.add_scatter(runs_for_derivatives(n_keys), *cost);
      forecaster.add_scatter(static_cast<double>(most_samples), *cost);
    }
  }
  forecast.memory = forecaster.memory();
  return forecast;
}

}  // namespace subimpact
