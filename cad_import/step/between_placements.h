#pragma once
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationRelationshipWithTransformation.hxx>

namespace nurbeam {

/// What brings a placement A to another one B is B A^-1 (ISO 10303-43), where OpenCASCADE takes A^-1 B: the
/// same unless both turn, or A turns or lies off its origin and B turns. These give a part that is placed so
/// in an assembly, or an item that is drawn so, another B, with which OpenCASCADE does what is meant. Throw
/// std::runtime_error where a placement has no origin in space or its axes are parallel.
void restate_between_axes(StepRepr_RepresentationRelationshipWithTransformation& relation);
void restate_between_axes(StepRepr_MappedItem& item);

}  // namespace nurbeam
