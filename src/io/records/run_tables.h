#pragma once

#include "io/records/csv_columns.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A table that a run writes: its file, and all that is needed to write and describe it.
template <class Row>
struct RunTable {
  const char* file;
  const char* meaning;   ///< of a row
  Columns<Row> columns;  ///< of every case
  std::vector<Row> Result::*rows;
  /// Adds the columns that only such a case has.
  void (*add_columns)(const OutputOptions& output, Columns<Row>& columns) = nullptr;

  Columns<Row> columns_of(const OutputOptions& output) const {
    Columns<Row> all = columns;
    if (add_columns != nullptr) add_columns(output, all);
    return all;
  }
};

/// For SubImpact, Transition, SupportContact, HistoryRow, SectionRow, PointRow, ShapeRow,
/// EnvelopeRow, StrikeRow.
template <class Row>
const RunTable<Row>& run_table();

template <class Use>
void for_each_run_table(Use use) {
  use(run_table<SubImpact>());
  use(run_table<Transition>());
  use(run_table<SupportContact>());
  use(run_table<HistoryRow>());
  use(run_table<SectionRow>());
  use(run_table<PointRow>());
  use(run_table<ShapeRow>());
  use(run_table<EnvelopeRow>());
  use(run_table<StrikeRow>());
}

template <class Row>
std::string csv_of(const Result& result) {
  const RunTable<Row>& table = run_table<Row>();
  return csv_text(table.columns, result.*table.rows);
}

}  // namespace subimpact
