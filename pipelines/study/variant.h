#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipelines/study/study_case.h"

namespace nurbeam {

/// Where the first error is and what it says, of a model that cannot be made.
std::string first_error(const std::vector<Diagnostic>& diagnostics);

/// How a variant ended.
enum class VariantStatus {
  done,
  rejected,   ///< a constraint of the study does not hold: it did not run
  refused,    ///< no model can be made of it
  failed,     ///< the run did not reach its end, or a quantity is no number
  timed_out,  ///< it took longer than the study allows
  crashed     ///< the process that ran it ended, or had no memory for it
};

/// "done", "timed out", ...
std::string name_of(VariantStatus status);
/// The inverse; nothing for another text.
std::optional<VariantStatus> variant_status(const std::string& name);

/// One row of a study.
struct Variant {
  std::size_t number = 0;      ///< from 0
  std::vector<double> values;  ///< of the variables, in their order
  VariantStatus status = VariantStatus::done;
  std::string reason = {};              ///< empty where it is done
  std::vector<double> quantities = {};  ///< in their order; empty where it is not done
  StudyGradient gradient = {};          ///< where the study asks for derivatives, and it is done
  double seconds = 0;                   ///< wall time
};

/// The values of all variables, of those of the free ones.
std::vector<double> all_values(const StudyFile& study, const std::vector<double>& free);

/// Runs the variant in which the variables have these values: never throws for what is wrong with it.
/// `study_case` is null where the study has no case. Nothing that comes out but the time depends on
/// `threads`, at least 1.
Variant run_variant(const StudyFile& study, const StudyCase* study_case, std::size_t number,
                    std::vector<double> values, int threads = 1);

/// Whether the nominal variant can be built with derivatives of all quantities.
bool has_derivatives(const StudyFile& study, const StudyCase* study_case);

/// What is wrong with the quantities of a study, found by building the nominal variant: columns that the run
/// does not have, histories where a number must be; only a warning where that variant cannot be built.
/// Nothing is run.
std::vector<Diagnostic> check_quantities(const StudyFile& study, const StudyCase* study_case);

}  // namespace nurbeam
