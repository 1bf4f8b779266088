#pragma once
#include <optional>

#include "cad_import/step/step_instances.h"

namespace nurbeam {

/// The representation that holds an instance, directly or not: of a shape, or supplemental geometry. Throws
/// std::runtime_error where none does.
int representation_of(int instance, const StepInstances& step);

/// The representation of the product that `representation` belongs to: itself, or the one it is related to.
int of_product(int representation, const StepInstances& step);

/// The context that a representation is in.
int context_of(int representation, const StepInstances& step);

/// The set of curves that an instance stands in itself; nothing where it does not.
std::optional<int> set_holding(int instance, const StepInstances& step);

/// A set of curves of the product that `representation` belongs to, in the same context, which CAD systems
/// show as one object; nothing where it has none.
std::optional<int> curve_set_of(int representation, const StepInstances& step);

/// The representation of the product that is a part of no other; nothing where there is none.
std::optional<int> topmost_representation(const StepInstances& step);

}  // namespace nurbeam
