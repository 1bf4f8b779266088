#pragma once
#include <optional>
#include <string>

class Standard_Transient;

namespace nurbeam {

/// What is wrong with the knots and weights of a B-spline curve as it stands in the file; nothing if all is
/// right, and for any other entity. OpenCASCADE itself drops knots that decrease, together with their control
/// points, silently.
std::optional<std::string> spline_defect(const Standard_Transient& entity);

}  // namespace nurbeam
