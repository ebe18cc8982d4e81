#include "integrate/sundials.h"

#include <klu.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace subimpact {
namespace {

class KluMassSolver final : public MassSolver {
 public:
  explicit KluMassSolver(const BandedMatrix& mass) : size_(static_cast<int>(mass.size())) {
    klu_defaults(&common_);
    const std::size_t n = mass.size();
    const std::size_t bandwidth = mass.half_bandwidth();
    std::vector<int> column_starts{0};
    std::vector<int> rows;
    std::vector<double> values;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = j > bandwidth ? j - bandwidth : 0; i < std::min(n, j + bandwidth + 1);
           ++i) {
        rows.push_back(static_cast<int>(i));
        values.push_back(mass.at(i, j));
      }
      column_starts.push_back(static_cast<int>(rows.size()));
    }
    symbolic_ = klu_analyze(size_, column_starts.data(), rows.data(), &common_);
    if (symbolic_) {
      numeric_ = klu_factor(column_starts.data(), rows.data(), values.data(), symbolic_, &common_);
    }
    if (!numeric_) {
      release();
      throw std::runtime_error("KLU could not factor the mass matrix (status " +
                               std::to_string(common_.status) + ")");
    }
  }
  ~KluMassSolver() override { release(); }
  KluMassSolver(const KluMassSolver&) = delete;
  KluMassSolver& operator=(const KluMassSolver&) = delete;

  void solve(std::span<double> x) const override {
    klu_solve(symbolic_, numeric_, size_, 1, x.data(), &common_);
  }

 private:
  void release() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  int size_;
  mutable klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace

std::unique_ptr<MassSolver> make_klu_mass_solver(const BandedMatrix& mass) {
  return std::make_unique<KluMassSolver>(mass);
}

std::string klu_version() {
  return std::to_string(KLU_MAIN_VERSION) + "." + std::to_string(KLU_SUB_VERSION) + "." +
         std::to_string(KLU_SUBSUB_VERSION);
}

}  // namespace subimpact
