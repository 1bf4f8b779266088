#pragma once
#include <filesystem>

#include "pipelines/study/study_case.h"

namespace nurbeam {

/// Writes best.json, the case of the variant with these values of the free variables, ready to run, and
/// best.step with the curves that variables have moved, where there are any. Throws std::runtime_error (file
/// and reason).
void write_best_variant(const std::filesystem::path& directory, const StudyFile& study,
                        const StudyCase& study_case, const std::vector<double>& point);

}  // namespace nurbeam
