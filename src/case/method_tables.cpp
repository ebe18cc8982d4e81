#include "subimpact/case/method_tables.h"

#include "integrate/arkode_ark.h"
#include "integrate/arkode_erk.h"
#include "integrate/nystrom_tables.h"

namespace subimpact {

const std::vector<MethodTable>& method_tables() {
  static const std::vector<MethodTable> tables = [] {
    std::vector<MethodTable> list;
    for (const ExplicitTable& table : explicit_tables()) {
      list.push_back({Method::erk, table.name, table.order, table.embedded_order, table.evaluations,
                      table.note});
    }
    for (const NystromTable& table : nystrom_tables()) {
      list.push_back({Method::nystrom, table.name, table.order, table.embedded_order,
                      table.evaluations(), table.note});
    }
    for (const ImplicitTable& table : dirk_tables()) {
      list.push_back(
          {Method::dirk, table.name, table.order, table.embedded_order, table.stages, table.note});
    }
    for (const ImplicitTable& table : imex_tables()) {
      list.push_back(
          {Method::imex, table.name, table.order, table.embedded_order, table.stages, table.note});
    }
    return list;
  }();
  return tables;
}

}  // namespace subimpact
