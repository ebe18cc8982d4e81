#include "subimpact/io/read_results.h"

#include <fmt/format.h>

#include "io/csv_reader.h"
#include "io/row_thinning.h"
#include "io/run_record.h"
#include "io/run_tables.h"
#include "io/sealed_files.h"

namespace subimpact {
namespace {

// The rows of a table: all of them, or of a long one those that figures need.
template <class Row>
std::vector<Row> read_table(const RunTable<Row>& table, const FinishedRun& run, std::istream& file,
                            const std::string& name) {
  const std::size_t group = table.group(run.input, run.result);
  CsvReader csv(file, name);
  RowOrder order(name);
  RowThinning<Row> rows(table.n_instants ? group * table.n_instants(run.result) : 0, group,
                        table.drawn);
  for_each_row(csv, table.columns, [&](const Row& row) {
    order.check(row);
    rows.add(row);
  });
  return rows.take();
}

FinishedRun read_once(const std::filesystem::path& directory, const SealedFiles& files) {
  FinishedRun run;
  read_summary(directory / "summary.json", files.text("summary.json"), run);
  if (!files.manifest() || files.manifest()->kind != "run") {
    throw ResultsError(
        fmt::format("{}: has no {} of a run, without which nothing shows that its files belong "
                    "together; run the case again",
                    directory.string(), manifest_name));
  }
  run.identity = files.manifest()->identity;
  for_each_run_table([&](const auto& table) {
    if (table.group(run.input, run.result) == 0) return;
    std::ifstream file = files.open(table.file);
    run.result.*table.rows = read_table(table, run, file, (directory / table.file).string());
  });
  const Result& result = run.result;
  if (!result.shapes.empty() && result.shapes.size() % result.used.n_shape_points != 0) {
    throw ResultsError(
        fmt::format("{}: has {} rows, which are no whole shapes of {} points; run the case again",
                    (directory / run_table<ShapeRow>().file).string(), result.shapes.size(),
                    result.used.n_shape_points));
  }
  return run;
}

}  // namespace

FinishedRun read_results(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) {
    throw ResultsError(
        fmt::format("{}: is not a directory; give the output directory of "
                    "`subimpact run` (--out)",
                    directory.string()));
  }
  return read_sealed(directory,
                     [&](const SealedFiles& files) { return read_once(directory, files); });
}

}  // namespace subimpact
