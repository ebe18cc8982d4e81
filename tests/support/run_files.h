#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace subimpact {

/// summary.json of a run.
inline nlohmann::json summary_in(const std::filesystem::path& directory) {
  std::ifstream file(directory / "summary.json");
  return nlohmann::json::parse(file);
}

/// A row of a table by the names of its columns; empty cells are not there.
struct TableRow : std::map<std::string, std::string> {
  double number(const std::string& column) const { return std::stod(at(column)); }
};

/// A table of a run.
inline std::vector<TableRow> table_in(const std::filesystem::path& file) {
  std::ifstream text(file);
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> heading = cells_of(line);
  std::vector<TableRow> rows;
  while (std::getline(text, line)) {
    const std::vector<std::string> cells = cells_of(line);
    TableRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].empty()) row[heading.at(i)] = cells[i];
    }
  }
  return rows;
}

}  // namespace subimpact
