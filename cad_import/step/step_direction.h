#pragma once
#include <Eigen/Core>
#include <StepGeom_Direction.hxx>
#include <optional>

namespace nurbeam {

/// The direction, of length 1; nothing where there is none.
std::optional<Eigen::Vector3d> direction_of(const opencascade::handle<StepGeom_Direction>& direction);

/// A DIRECTION without name.
opencascade::handle<StepGeom_Direction> step_direction(const Eigen::Vector3d& direction);

/// What ISO 10303-42 projects into the plane at right angles to the third axis where the first one is not
/// given: x, or y where the third is along x.
Eigen::Vector3d default_first_axis(const Eigen::Vector3d& third);

}  // namespace nurbeam
