#pragma once

namespace nurbeam {

/// `brep` is OpenCASCADE's own format, as text; IFC files are read only.
enum class CadFormat { step, iges, dxf, brep, ifc };

/// The application protocol that a STEP file follows: ISO 10303-214 or -242.
enum class StepSchema { ap214, ap242 };

}  // namespace nurbeam
