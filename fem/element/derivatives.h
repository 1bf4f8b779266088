#pragma once

namespace nurbeam {

/// How many derivatives are wanted: forces need one, tangents two.
enum class Derivatives { one, two };

}  // namespace nurbeam
