#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace nurbeam {

/// Prints rows of cells, headings first, in columns as wide as their widest cell, two spaces before each.
/// Where lines are longer than `width` (0: any length), columns are left out, in the order in which
/// `dispensable` has their headings, until they fit or none of these is left. Returns the headings left out.
std::vector<std::string> print_table(std::ostream& out, std::vector<std::vector<std::string>> rows,
                                     int width = 0, const std::vector<std::string>& dispensable = {});

}  // namespace nurbeam
