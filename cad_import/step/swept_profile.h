#pragma once
#include <TopoDS_Shape.hxx>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The solid [mm] that a profile sweeps, with flat ends: one B-spline face for each cubic of its outline and
/// its holes. Throws std::runtime_error when that is no valid solid of the profile's volume, within 1e-3. To
/// be called in a child process: OpenCASCADE may crash.
TopoDS_Shape swept_profile(const SweptProfile& profile);

}  // namespace nurbeam
