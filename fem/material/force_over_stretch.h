#pragma once
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/material/axial_point.h"
#include "fem/material/force_rows.h"

namespace nurbeam {

/// A law F(e) by rows (engineering strain e [-], force F [N]). The rows hold for the unstressed beam: no EA
/// enters.
class ForceOverStretch {
 public:
  /// Throws std::invalid_argument for rows that do not increase, or that begin at -1 or below.
  explicit ForceOverStretch(std::vector<std::pair<double, double>> rows) : rows_(std::move(rows)) {
    if (rows_.rows().front().first <= -1)
      throw std::invalid_argument("the first row has a stretch of -1 or less; at -1 a beam has no length");
  }

  template <class T>
  AxialPoint<T> operator()(double, const T& strain, double free) const {
    return of_engineering_strain(
        strain, free,
        [this](const T& e) {
          return AxialPoint<T>{each(
                                   e, [this](double x) { return rows_.at(x).energy; }),
                               each(
                                   e, [this](double x) { return rows_.at(x).force; }),
                               each(
                                   e, [this](double x) { return rows_.at(x).stiffness; })};
        });
  }

  const ForceRows& rows() const { return rows_; }
  bool operator==(const ForceOverStretch&) const = default;

 private:
  ForceRows rows_;
};

}  // namespace nurbeam
