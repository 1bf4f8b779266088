#pragma once
#include <memory>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/model_snapshot.h"

namespace nurbeam::python {

/// A case and the model that it is: what a run needs, and keeps alive.
struct BuiltCase {
  CaseFile case_file;
  BuildReport report;  ///< with a model

  const BuiltModel& built() const { return *report.value; }
};

}  // namespace nurbeam::python
