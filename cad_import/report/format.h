#pragma once

namespace nurbeam {

/// `brep` is OpenCASCADE's own format, as text; `json` curves as NURBS; IFC files are read only, SVG files
/// written only.
enum class CadFormat { step, iges, dxf, brep, ifc, json, svg };
constexpr CadFormat last_format = CadFormat::svg;

/// The application protocol that a STEP file follows: ISO 10303-214 or -242.
enum class StepSchema { ap214, ap242 };

}  // namespace nurbeam
