#pragma once
#include <string>

class Standard_Transient;

namespace nurbeam {

/// What is wrong with the knots and weights of a B-spline curve as it stands in the file; "" if nothing is,
/// and for any other entity. OpenCASCADE itself drops knots that decrease, together with their control
/// points, silently.
std::string spline_defect(const Standard_Transient& entity);

}  // namespace nurbeam
