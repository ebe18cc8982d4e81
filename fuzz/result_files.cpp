#include <sstream>
#include <string>

#include "io/records/csv_reader.h"
#include "io/records/run_record.h"
#include "io/records/run_tables.h"
#include "subimpact/io/read_results.h"
#include "subimpact/report/text.h"
#include "targets.h"

namespace subimpact::fuzz {
namespace {

template <class Row>
void read_table(const std::string& text, const Columns<Row>& columns) {
  std::istringstream file(text);
  CsvReader csv(file, "table.csv");
  RowOrder checks("table.csv");
  for_each_row(csv, columns, [&](const Row& row) { checks.check(row); });
}

void read(std::uint8_t kind, const std::string& text) {
  switch (kind % 5) {
    case 0: {
      FinishedRun run;
      read_summary("summary.json", text, run);
      run_summary(run.input, run.result);
      break;
    }
    case 1:
      return read_table(text, run_table<SubImpact>().columns);
    case 2:
      return read_table(text, run_table<Transition>().columns);
    case 3:
      return read_table(text, run_table<HistoryRow>().columns);
    default:
      return read_table(text, run_table<SectionRow>().columns);
  }
}

}  // namespace

void result_files(Bytes bytes) {
  if (bytes.empty()) return;
  try {
    read(bytes[0], std::string(bytes.begin() + 1, bytes.end()));
  } catch (const ResultsError&) {
  }
}

}  // namespace subimpact::fuzz
