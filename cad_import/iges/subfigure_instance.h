#pragma once
#include <Eigen/Geometry>

class IGESBasic_SingularSubfigure;

namespace nurbeam {

/// Whether the instance (408) scales its subfigure.
bool is_scaled(const IGESBasic_SingularSubfigure& instance);

/// Whether it matters that its translation comes after its matrix (124): that turns it, and there is one.
bool is_moved_after_turning(const IGESBasic_SingularSubfigure& instance);

/// Where the instance puts its subfigure, in the unit of the file: at its scale, then under its matrix (124),
/// then moved by its translation, which is one in the space of what refers to the instance (IGES 5.3, 4.137).
/// Throws std::runtime_error where its scale is not positive, or its matrix stretches.
Eigen::Affine3d place_of(const IGESBasic_SingularSubfigure& instance);

/// Puts the subfigure there instead; the placement must not scale.
void set_place(IGESBasic_SingularSubfigure& instance, const Eigen::Affine3d& place);

}  // namespace nurbeam
