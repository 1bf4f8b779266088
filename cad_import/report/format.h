#pragma once

namespace nurbeam {

/// `brep` is OpenCASCADE's own format, as text.
enum class CadFormat { step, iges, dxf, brep };

/// The application protocol that a STEP file follows: ISO 10303-214 or -242.
enum class StepSchema { ap214, ap242 };

}  // namespace nurbeam
