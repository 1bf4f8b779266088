#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace nurbeam {

/// A problem with a known answer as `nurbeam verify` has found it.
struct VerifiedProblem {
  std::string name;
  int rows = 0;                    ///< number of its numbers with a reference, without orders of convergence
  double least = 0, greatest = 0;  ///< of their errors: relative, or absolute where the reference is 0
  std::set<std::string> features;  ///< of its models and analyses (features_of)
};

/// A known answer counts as evidence if a run meets it so well.
inline constexpr double close_error = 1e-4;

/// The table, one problem a line: name, rows, least and greatest error, features by semicolons; tabs between.
std::string text_of(const std::vector<VerifiedProblem>& problems);
/// The problems of a table. Throws std::invalid_argument, with the line, where it is none.
std::vector<VerifiedProblem> read_verified(std::string_view table);

/// The evidence for one feature of a run.
struct FeatureEvidence {
  std::string feature;
  /// Verified problems with it: first those met within close_error, in the order of how much they have in
  /// common with the run; three at most.
  std::vector<VerifiedProblem> problems;

  bool is_covered() const { return !problems.empty() && problems[0].least <= close_error; }
};

/// The evidence for each of the features of a run.
std::vector<FeatureEvidence> evidence_for(const std::set<std::string>& features,
                                          const std::vector<VerifiedProblem>& verified);

}  // namespace nurbeam
