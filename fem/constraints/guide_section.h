#pragma once
#include <array>

#include "fem/element/section_frame.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// The section of a rigid guide where a body is: one coordinate, the place. The guide's segment at the place
/// in the plan goes on beyond its ends, as for BodyOnGuide.
class GuideSection {
 public:
  static constexpr int size = 1;

  GuideSection(const MeshedBeams<3>& at, const Eigen::VectorXd&, int rider)
      : curve_(&at.structure.beam_of(at.structure.riders[rider]).curve),
        segment_(curve_->segment_at(at.mesh.plan.places[rider])),
        dofs_{at.mesh.riders[rider].place} {}

  const std::array<int, size>& dofs() const { return dofs_; }
  Eigen::Matrix<double, 1, 1> coordinates(const MeshedBeams<3>&, const Eigen::VectorXd& q) const {
    return Eigen::Matrix<double, 1, 1>(q[dofs_[0]]);
  }

  /// The section as a series in the place.
  struct Here {
    DrawnSectionSeries series;

    template <class T>
    SectionTriad<T> triad(const Eigen::Matrix<T, 1, 1>& x) const {
      const auto vector = [&](const std::array<Eigen::Vector3d, 3>& of) {
        Vector3<T> y;
        for (int k = 0; k < 3; ++k) y[k] = compose({of[0][k], of[1][k], of[2][k], 0}, x[0]);
        return y;
      };
      return {vector(series.d1), vector(series.d2), vector(series.t)};
    }
  };
  Here here(const MeshedBeams<3>&, const Eigen::Matrix<double, 1, 1>& x) const {
    return {curve_->section_series(segment_, x[0])};
  }

 private:
  const ReferenceCurve* curve_;
  int segment_;
  std::array<int, size> dofs_;
};

}  // namespace nurbeam
