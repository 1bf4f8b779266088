#pragma once
#include <filesystem>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// Writes the curves, one B-spline curve entity each, under their names, in the unit, at full (17 digits)
/// precision; STEP or IGES by the extension (.step .stp .igs .iges). Written to a temporary name and renamed;
/// when it cannot be written it is as it was before, and a Diagnostic of severity error says why. Throws
/// std::invalid_argument for an unknown extension (naming the known ones), for no curves and for a name with
/// a control character.
[[nodiscard]] std::vector<Diagnostic> export_curves(const std::filesystem::path& file,
                                                    const std::vector<NamedCurve>& curves, LengthUnit unit);

/// Writes each pipe as a solid (its axis swept by a disk or an annulus, ends cut square) under its name, to a
/// STEP file, else as export_curves does. Lines and arcs become cylinders and tori; other faces are
/// OpenCASCADE's approximation, with a volume that agrees with the section times the length within 1e-5. When
/// a curve cannot be swept (a corner, a bend sharper than the radius, most rings that lie in no plane)
/// nothing is written and a Diagnostic of severity error says why. Throws std::invalid_argument also for
/// another extension than .step or .stp, for a radius that is not positive and for a bore that is negative or
/// not below the radius.
[[nodiscard]] std::vector<Diagnostic> export_solids(const std::filesystem::path& file,
                                                    const std::vector<NamedPipe>& pipes, LengthUnit unit);

}  // namespace nurbeam
