#pragma once

class StepGeom_CurveReplica;

namespace nurbeam {

/// Puts the scale and the mirror of a curve replica, which OpenCASCADE leaves out, into its parent curve. Its
/// units must be those that OpenCASCADE goes by. Throws std::runtime_error where the parent is a composite or
/// an offset curve, or the transformation is none.
void restate_replica(StepGeom_CurveReplica& replica);

}  // namespace nurbeam
