#pragma once

#include "testing.h"

namespace subimpact {

/// Errors over a refined resolution, printed as a table of resolution, error, ratio and order, and
/// held against a band with two sides: an order above the expected one is as wrong as one below it.
class OrderTable {
 public:
  explicit OrderTable(std::string title) : title_(std::move(title)) {}

  /// `resolution` grows with refinement (cells, steps, layers).
  void add(double resolution, double error) { rows_.push_back({resolution, error}); }

  std::size_t size() const { return rows_.size(); }

  double order(std::size_t row) const { return order_between(rows_[row - 1], rows_[row]); }

  /// Order over all rows at once: from the first to the last.
  double overall_order() const { return order_between(rows_.front(), rows_.back()); }

  /// Order over the last `n` rows.
  double finest_order(std::size_t n) const {
    return order_between(rows_[rows_.size() - n], rows_.back());
  }

  void print() const {
    std::printf("%s\n%12s %14s %10s %8s\n", title_.c_str(), "resolution", "error", "ratio",
                "order");
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      std::printf("%12g %14.6e", rows_[i].resolution, rows_[i].error);
      if (i > 0) std::printf(" %10.4f %8.4f", rows_[i - 1].error / rows_[i].error, order(i));
      std::printf("\n");
    }
  }

  /// Prints, and expects the order of every refinement to lie in [low, high].
  void expect_every_order_within(double low, double high) const {
    print();
    ASSERT_GE(rows_.size(), 3u) << title_;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      EXPECT_GE(order(i), low) << title_ << ", resolution " << rows_[i].resolution;
      EXPECT_LE(order(i), high) << title_ << ", resolution " << rows_[i].resolution;
    }
  }

  /// Expects the overall order to lie in [low, high].
  void expect_overall_order_within(double low, double high) const {
    ASSERT_GE(rows_.size(), 3u) << title_;
    EXPECT_GE(overall_order(), low) << title_;
    EXPECT_LE(overall_order(), high) << title_;
  }

  /// Expects the order over the last `n` rows to lie in [low, high].
  void expect_finest_order_within(std::size_t n, double low, double high) const {
    ASSERT_GE(rows_.size(), n) << title_;
    EXPECT_GE(finest_order(n), low) << title_;
    EXPECT_LE(finest_order(n), high) << title_;
  }

 private:
  struct Row {
    double resolution, error;
  };
  static double order_between(const Row& coarse, const Row& fine) {
    return std::log(coarse.error / fine.error) / std::log(fine.resolution / coarse.resolution);
  }

  std::string title_;
  std::vector<Row> rows_;
};

}  // namespace subimpact
