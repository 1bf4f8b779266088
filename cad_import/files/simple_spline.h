#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace nurbeam {

/// The value of a STEP instance, from behind "=" to before ";", that is a B-spline without weights written as
/// a complex one, as the simple instance that says the same; nothing of any other. OpenCASCADE reads complex
/// ones with weights only.
std::optional<std::string> simple_spline(std::string_view value);

}  // namespace nurbeam
