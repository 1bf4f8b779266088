#pragma once
#include "pipelines/case/case_json.h"

namespace nurbeam {

/// Puts the rows of CSV files where tables of a case file name them, { "file": "x.csv", "columns": [...] };
/// null, and a finding, where that cannot be. Files are relative to `directory`. What is no such table stays
/// as it is.
///
/// A file has a row a line: numbers in SI units with commas, semicolons, tabs or spaces between them. A first
/// line that is not of numbers names the columns; lines that are empty or begin with # do not count.
void put_in_tables(const Shape& shape, Json& value, const std::string& path,
                   const std::filesystem::path& directory, Findings& findings);

}  // namespace nurbeam
