#include "pipelines/run/run_evidence.h"

#include "pipelines/model/features.h"
#include "pipelines/results/verified_table.h"
#include "pipelines/run/mode_run.h"
#include "pipelines/run/simulation_plan.h"

namespace nurbeam {

std::vector<FeatureEvidence> run_evidence(const CaseFile& case_file, const BuiltModel& built) {
  Features features = features_of(built.model);
  features.merge(case_file.analysis.has_modes() ? features_of(modes_options(case_file.analysis))
                                                : features_of(simulation_options(case_file)));
  return evidence_for(features, read_verified(verified_table));
}

}  // namespace nurbeam
