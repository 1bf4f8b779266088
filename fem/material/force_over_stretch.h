#pragma once
#include <utility>
#include <vector>

#include "fem/material/axial_point.h"

namespace nurbeam {

/// A law F(e) by rows (engineering strain e [-], force F [N]), joined by a C1 cubic that grows where the rows
/// do, and straight beyond them. The rows hold for the unstressed beam: no EA enters.
class ForceOverStretch {
 public:
  /// Throws std::invalid_argument unless there are at least two rows, and both numbers increase.
  explicit ForceOverStretch(std::vector<std::pair<double, double>> rows);

  template <class T>
  AxialPoint<T> operator()(double, const T& strain, double free) const {
    return of_engineering_strain(
        strain, free,
        [this](const T& e) {
          return AxialPoint<T>{each(
                                   e, [this](double x) { return at(x).energy; }),
                               each(
                                   e, [this](double x) { return at(x).force; }),
                               each(
                                   e, [this](double x) { return at(x).stiffness; })};
        });
  }

  /// W, F and F' at an engineering strain; W(0) = 0.
  AxialPoint<double> at(double e) const;
  const std::vector<std::pair<double, double>>& rows() const { return rows_; }
  bool operator==(const ForceOverStretch& other) const { return rows_ == other.rows_; }

 private:
  AxialPoint<double> from_start(double e) const;

  std::vector<std::pair<double, double>> rows_;
  std::vector<double> slopes_, energies_;  ///< at the rows; energies counted from the first row
  double energy_at_zero_ = 0;
};

}  // namespace nurbeam
