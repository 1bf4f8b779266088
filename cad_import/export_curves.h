#pragma once
#include <filesystem>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "cad_import/report/format.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The format that a file is written in, by its extension: .step .stp .igs .iges .dxf .brep .brp
/// .json .svg. Throws
/// std::invalid_argument for another one, which names these.
CadFormat written_format(const std::filesystem::path& file);

/// Writes the curves, one B-spline curve entity each, in the unit, at full precision (17 digits; 15 in BREP),
/// in written_format(): under their names in STEP and IGES, on a layer of that name in DXF; BREP has none,
/// and its unit is the millimetre; SVG holds curves of one plane, those with weights within 1e-6 of the size.
/// Written to a temporary name and renamed; when it cannot be written it is as it was before, and a
/// Diagnostic of severity error says why. Spaces stand for control characters of names. Throws
/// std::invalid_argument for an unknown extension (naming the known ones), for another unit in BREP and for
/// no curves.
[[nodiscard]] std::vector<Diagnostic> export_curves(const std::filesystem::path& file,
                                                    const std::vector<NamedCurve>& curves, LengthUnit unit,
                                                    StepSchema schema = StepSchema::ap214);

/// One of several files.
struct CurvesFile {
  std::filesystem::path path;
  std::vector<NamedCurve> curves;
  LengthUnit unit;
  StepSchema schema = StepSchema::ap214;
};

/// Writes each of them as export_curves does, with one start of the program that knows CAD files for all.
[[nodiscard]] std::vector<Diagnostic> export_curves(const std::vector<CurvesFile>& files);

/// Writes each pipe as a solid (its axis swept by a disk or an annulus, ends cut square) under its name, to a
/// STEP or BREP file, else as export_curves does. Runs of lines and arcs become cylinders and tori; other
/// faces are B-splines within 1e-6 of the radius. Corners are mitred. When a curve cannot be swept (a bend
/// sharper than the radius, pieces between corners too short for their mitres, a cable that runs into itself)
/// nothing is written and a Diagnostic of severity error says why. Throws std::invalid_argument also for
/// another extension than .step, .stp, .brep or .brp, for a radius that is not positive and for a bore that
/// is negative or not below the radius.
[[nodiscard]] std::vector<Diagnostic> export_solids(const std::filesystem::path& file,
                                                    const std::vector<NamedPipe>& pipes, LengthUnit unit,
                                                    StepSchema schema = StepSchema::ap214);

/// The same of pipes and swept profiles: those as export_solids does, of these each face a B-spline through
/// the sections that are given. Throws std::invalid_argument also for a profile without a loop of cubics,
/// rails of one cubic that differ in their knots, and a volume that is not positive.
[[nodiscard]] std::vector<Diagnostic> export_solids(const std::filesystem::path& file,
                                                    const std::vector<NamedSolid>& solids, LengthUnit unit,
                                                    StepSchema schema = StepSchema::ap214);

}  // namespace nurbeam
