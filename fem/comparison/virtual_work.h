#pragma once
#include "fem/element/beam_element.h"

/// The papers' form P: virtual work at fixed material points inside moving limits, Eqs. 18-19 of Ding &
/// Ouyang, for comparison with the element's own forces: it drifts.
namespace nurbeam::virtual_work {

/// M q'' + Q in form P, arguments as for BeamElement::force, for an element whose ends move.
template <int D>
ElementVector<D> force(const BeamElement<D>& element, const ElementState<D>& x,
                       const Eigen::Matrix<double, D, 1>& load);
/// The derivative of the force, arguments as for BeamElement::tangent.
template <int D>
ElementMatrix<D> tangent(const BeamElement<D>& element, const ElementState<D>& x,
                         const Eigen::Matrix<double, D, 1>& load, const TangentWeights& w);

extern template ElementVector<2> force<2>(const BeamElement<2>&, const ElementState<2>&,
                                          const Eigen::Vector2d&);
extern template ElementVector<3> force<3>(const BeamElement<3>&, const ElementState<3>&,
                                          const Eigen::Vector3d&);
extern template ElementMatrix<2> tangent<2>(const BeamElement<2>&, const ElementState<2>&,
                                            const Eigen::Vector2d&, const TangentWeights&);
extern template ElementMatrix<3> tangent<3>(const BeamElement<3>&, const ElementState<3>&,
                                            const Eigen::Vector3d&, const TangentWeights&);

}  // namespace nurbeam::virtual_work
