#pragma once
#include <gtest/gtest.h>

#include "pipelines/study/study_file.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam::test {

/// The study of a text, which must be right.
inline StudyFile study_of(const std::string& text) {
  const TemporaryDirectory directory;
  StudyFileReport read = read_study_file(directory.write("study.json", text));
  for (const Diagnostic& d : read.diagnostics) ADD_FAILURE() << d.where << ": " << d.message;
  return std::move(*read.value);
}

/// All that is wrong with a text.
inline std::string wrong_with(const std::string& text) {
  const TemporaryDirectory directory;
  std::string all;
  for (const Diagnostic& d : read_study_file(directory.write("study.json", text)).diagnostics)
    all += d.where.substr(d.where.find("study.json")) + ": " + d.message + "\n";
  return all;
}

}  // namespace nurbeam::test
