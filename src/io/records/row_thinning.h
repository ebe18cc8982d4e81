#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace subimpact {

/// Collects rows of a table, all of a short one, and of a long one those that a figure needs: the
/// table is cut into spans, and each leaves its first row and, for every value drawn, the rows
/// where the value is smallest and largest. Rows come in groups of equal number (the sections at an
/// instant), which stay together. The last group is kept.
template <class Row>
class RowThinning {
 public:
  /// Some `most_rows` of `n_rows` rows are kept, or all.
  RowThinning(std::size_t n_rows, std::size_t group, std::vector<double Row::*> drawn,
              std::size_t most_rows = 400'000)
      : group_(group), drawn_(std::move(drawn)) {
    if (n_rows <= most_rows) return;
    const std::size_t kept_per_span = group * (1 + 2 * group * drawn_.size());
    span_ = n_rows / group / std::max<std::size_t>(most_rows / kept_per_span, 1) + 1;
  }

  void add(const Row& row) {
    pending_.push_back(row);
    if (pending_.size() == span_ * group_) reduce();
  }

  std::vector<Row> take() {
    const std::size_t n_last = std::min(group_, pending_.size());
    const std::vector<Row> last(pending_.end() - static_cast<std::ptrdiff_t>(n_last),
                                pending_.end());
    reduce();
    if constexpr (requires { last.back().time; }) {
      if (!last.empty() && rows_.back().time < last.back().time) {
        rows_.insert(rows_.end(), last.begin(), last.end());
      }
    }
    return std::move(rows_);
  }

 private:
  void reduce() {
    std::vector<std::size_t> kept = {0};  // index of the first row of each group
    for (std::size_t member = 0; member < std::min(group_, pending_.size()); ++member) {
      for (const auto value : drawn_) {
        std::size_t low = member, high = member;
        for (std::size_t i = member; i < pending_.size(); i += group_) {
          if (pending_[i].*value < pending_[low].*value) low = i;
          if (pending_[i].*value > pending_[high].*value) high = i;
        }
        kept.push_back(low - member);
        kept.push_back(high - member);
      }
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t first : kept) {
      const std::size_t end = std::min(first + group_, pending_.size());
      for (std::size_t i = first; i < end; ++i) rows_.push_back(pending_[i]);
    }
    pending_.clear();
  }

  std::size_t group_;
  std::size_t span_ = 1;  // groups
  std::vector<double Row::*> drawn_;
  std::vector<Row> rows_, pending_;
};

}  // namespace subimpact
