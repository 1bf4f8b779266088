#pragma once

namespace nurbeam {

/// Number of derivatives that are wanted: forces need one, tangents two.
enum class Derivatives { one, two };

}  // namespace nurbeam
