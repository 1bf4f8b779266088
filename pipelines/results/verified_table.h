#pragma once
#include <string_view>

namespace nurbeam {

/// verified.tsv, which `nurbeam verify --write FILE` makes and the program carries: one problem a line, as
/// read_verified() takes it.
extern const std::string_view verified_table;

}  // namespace nurbeam
