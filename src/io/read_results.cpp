#include "subimpact/io/read_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include "case/refuse.h"
#include "io/directory/listed_files.h"
#include "io/records/csv_reader.h"
#include "io/records/row_thinning.h"
#include "io/records/run_record.h"
#include "io/records/run_tables.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

// The rows of a table: all of them, or of a long one those that figures need.
template <class Row>
std::vector<Row> read_table(const RunTable<Row>& table, const FinishedRun& run, std::istream& file,
                            const std::string& name) {
  const std::size_t group = table.group(run.input, run.result);
  CsvReader csv(file, name);
  RowOrder order(name);
  RowThinning<Row> rows(table.n_instants ? group * table.n_instants(run.result) : 0, group,
                        table.drawn);
  for_each_row(csv, table.columns_of(run.input.output), [&](const Row& row) {
    order.check(row);
    rows.add(row);
  });
  return rows.take();
}

FinishedRun read_once(const fs::path& directory, const ListedFiles& files) {
  FinishedRun run;
  read_summary(directory / "summary.json", files.text("summary.json"), run);
  if (!files.manifest() || files.manifest()->kind != "run") {
    fail<ResultsError>(
        "{}: has no {} of a run, without which nothing shows that its files belong together; run "
        "the case again",
        directory.string(), manifest_name);
  }
  run.identity = files.manifest()->identity;
  for_each_run_table([&](const auto& table) {
    if (table.group(run.input, run.result) == 0) return;
    std::ifstream file = files.open(table.file);
    run.result.*table.rows = read_table(table, run, file, (directory / table.file).string());
  });
  const Result& result = run.result;
  if (!result.shapes.empty() && result.shapes.size() % result.used.n_shape_points != 0) {
    fail<ResultsError>(
        "{}: has {} rows, which are no whole shapes of {} points; run the case again",
        (directory / run_table<ShapeRow>().file).string(), result.shapes.size(),
        result.used.n_shape_points);
  }
  return run;
}

constexpr const char* runs_name = "runs.csv";
constexpr const char* sub_impacts_name = "sub_impacts.csv";
constexpr const char* remedy = "run the sweep again; it keeps the runs in its store";

struct SweptSubImpact : SubImpact {
  long run = 0;
};

// The number of the run, then the columns of events.csv.
Columns<SweptSubImpact> sub_impact_columns() {
  Columns<SweptSubImpact> columns = {{"run", &SweptSubImpact::run}};
  for (const Column<SubImpact>& of_run : run_table<SubImpact>().columns) {
    if (!of_run.read) continue;
    Column<SweptSubImpact> column(of_run.name, [](const SweptSubImpact&) { return 0.0; });
    column.allowed = of_run.allowed;
    column.read = of_run.read;
    columns.push_back(std::move(column));
  }
  return columns;
}

std::optional<std::vector<double>> as_numbers(const std::vector<std::string>& cells) {
  std::vector<double> numbers;
  for (const std::string& cell : cells) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!cell.empty() && !read_cell(cell, value)) return std::nullopt;
    numbers.push_back(value);
  }
  return numbers;
}

SweptRuns read_runs(const ListedFiles& files, const fs::path& path) {
  std::ifstream file = files.open(path.filename());
  CsvReader csv(file, path.string(), remedy);
  const std::size_t n = csv.heading().size();
  const std::size_t run = csv.find("run"), outcome = csv.find("outcome");
  if (run == n) csv.refuse_lack_of("run");
  if (outcome == n) csv.refuse_lack_of("outcome");
  SweptRuns runs;
  std::vector<std::vector<std::string>> cells(n);
  while (csv.next()) {
    long number = 0;
    const long least = runs.numbers.empty() ? 0 : runs.numbers.back() + 1;
    if (!read_cell(csv.cell(run), number) || number < least) {
      csv.refuse_cell(run, "whole numbers from 0, in ascending order");
    }
    if (csv.cell(outcome).empty()) csv.refuse_cell(outcome, "how the run ended");
    runs.numbers.push_back(number);
    for (std::size_t k = 0; k < n; ++k) cells[k].emplace_back(csv.cell(k));
  }
  if (runs.numbers.empty()) fail<ResultsError>("{}: has no run yet; {}", path.string(), remedy);
  for (std::size_t k = 0; k < n; ++k) {
    if (k == run) continue;
    SweptRuns::Column column{csv.heading()[k], k > run && k < outcome, {}, {}};
    const auto numbers = k == outcome ? std::nullopt : as_numbers(cells[k]);
    if (!numbers) {
      column.words = std::move(cells[k]);
    } else if (std::ranges::any_of(*numbers, [](double x) { return !std::isnan(x); })) {
      column.numbers = *numbers;
    } else {
      continue;
    }
    runs.columns.push_back(std::move(column));
  }
  return runs;
}

void read_sub_impacts(const ListedFiles& files, const fs::path& path, SweptRuns& runs) {
  std::map<long, std::size_t> places;
  for (const long number : runs.numbers) places.emplace(number, places.size());
  runs.sub_impacts.resize(runs.numbers.size());
  std::ifstream file = files.open(path.filename());
  CsvReader csv(file, path.string(), remedy);
  std::optional<long> before;
  std::optional<RowOrder> order;
  for_each_row(csv, sub_impact_columns(), [&](const SweptSubImpact& row) {
    const auto place = places.find(row.run);
    if (place == places.end()) csv.refuse_cell(csv.find("run"), "a run of runs.csv");
    if (row.run != before) {
      if (!runs.sub_impacts[place->second].empty()) {
        csv.refuse_cell(csv.find("run"), "rows of one run after each other");
      }
      order.emplace(fmt::format("{}, run {}", path.string(), row.run));
    }
    before = row.run;
    order->check(static_cast<const SubImpact&>(row));
    runs.sub_impacts[place->second].push_back(row);
  });
}

}  // namespace

FinishedRun read_results(const fs::path& directory) {
  std::error_code ignored;
  if (!fs::is_directory(directory, ignored)) {
    fail<ResultsError>(
        "{}: is not a directory; give the output directory of `subimpact run` (--out)",
        directory.string());
  }
  return read_once(directory, ListedFiles(directory));
}

const SweptRuns::Column* SweptRuns::find(std::string_view name) const {
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

bool holds_sweep(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / runs_name, ignored) &&
         !fs::exists(directory / "summary.json", ignored);
}

SweptRuns read_sweep(const fs::path& directory) {
  const ListedFiles files(directory);
  SweptRuns runs = read_runs(files, directory / runs_name);
  read_sub_impacts(files, directory / sub_impacts_name, runs);
  if (files.are_listed()) runs.identity = files.manifest()->identity;
  return runs;
}

}  // namespace subimpact
