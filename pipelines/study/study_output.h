#pragma once
#include <filesystem>

#include "pipelines/study/study_run.h"

namespace nurbeam {

/// study.csv: a row for each variant, by number: variables, quantities, status, wall time, reason. Like all
/// here it throws std::runtime_error (file and reason) where it cannot be written, and leaves no half of a
/// file.
void write_study_table(const std::filesystem::path& file, const StudyFile& study, const StudyResult& result);

/// study.nc: the same as arrays over "variant"; missing where there is no number.
void write_study_netcdf(const std::filesystem::path& file, const StudyFile& study, const StudyResult& result);

/// study.json: the study, its counts, its answer, and the checksum of the table that goes with it.
void write_study_summary(const std::filesystem::path& file, const StudyFile& study, const StudyResult& result,
                         const std::filesystem::path& table);

/// The same as a text: its counts, its answer and surrogates.
std::string study_summary(const StudyFile& study, const StudyResult& result);

/// What a study would run, in lines for people.
std::string study_plan_text(const StudyFile& study);

/// The answer in lines for people; empty where there is none.
std::string answer_text(const StudyFile& study, const StudyResult& result);

}  // namespace nurbeam
