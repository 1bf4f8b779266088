#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cad_import/iges/iges_records.h"

namespace nurbeam {

/// "BSplineCurve" of 126; "entity 999" of kinds that are not read.
std::string iges_kind(int type);

/// The number that a value is, 0 where it is empty; nothing where it is none.
std::optional<double> iges_number(const std::string& value);

/// What of the values of an entity is lost or no number, which OpenCASCADE would take for zeros; nothing
/// where all that its kind needs is there, and for kinds without such values.
std::optional<std::string> values_defect(const IgesRecord& record, const std::vector<std::string>& values);

/// How many numbers in the lists of a curve are empty, and so 0: points, knots, weights. Lines and arcs,
/// whose zeros programs do leave out, have none.
std::size_t empty_numbers(const IgesRecord& record, const std::vector<std::string>& values);

/// Where the values name other entities that this one is made of; empty for kinds that are not made of
/// others.
std::vector<std::size_t> parts_in(const IgesRecord& record, const std::vector<std::string>& values);

}  // namespace nurbeam
