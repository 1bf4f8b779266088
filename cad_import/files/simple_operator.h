#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace nurbeam {

/// The value of a STEP instance, from behind "=" to before ";", that is a
/// CARTESIAN_TRANSFORMATION_OPERATOR_3D written as a complex one, as the simple instance that says the same;
/// nothing of any other. OpenCASCADE passes over complex ones, and with them over the place that they give.
std::optional<std::string> simple_operator(std::string_view value);

}  // namespace nurbeam
