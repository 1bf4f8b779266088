#pragma once
#include "pipelines/case/case_values.h"
#include "pipelines/study/study_file.h"

/// Private to the reader of study files.
namespace nurbeam {

/// What all parts of a study file are read with; what is wrong goes to the findings.
class StudyPartReader {
 public:
  StudyPartReader(const Json& json, StudyFile& study, Findings& findings)
      : json_(json), study_(study), findings_(findings) {}

 protected:
  std::optional<Expression> parsed(const std::string& source, const std::string& path);
  /// 0 stands for an expression that is wrong, so that it is not missed elsewhere.
  Expression parsed_or_zero(const std::string& source, const std::string& path);
  /// Whether it names only those; `what` they are, for the message.
  bool check_names(const Expression& expression, const std::string& path, const std::string& what,
                   const std::vector<std::string>& known);
  /// Of one that stands where there are only numbers: it must do without histories and events.
  void check_number(const Expression& expression, const std::string& path);
  /// Whether each of the file's "variables" or "quantities" could be read, and has a name.
  bool all_named(const char* key) const;
  /// A number, or a text with a unit of that dimension.
  std::optional<double> measured(const Json& value, Dimension dimension, const std::string& path);
  std::vector<double> all_measured(const Json& values, Dimension dimension, const std::string& path);
  void check_increasing(const std::vector<double>& values, const std::string& path);
  /// What the values of a variable measure.
  Dimension dimension_of(const StudyVariable& variable, const std::string& path);
  void check_quantity(const std::string& name, const std::string& path);

  const Json& json_;
  StudyFile& study_;
  Findings& findings_;
};

/// Reads the `distribution` of a variable, of a file whose earlier variables have been read: those with a
/// range may make its parameters.
void read_study_distribution(const Json& whole, const Json& json, Dimension dimension,
                             StudyVariable& variable, StudyFile& study, Findings& findings);
/// Whether a parameter of a distribution, as it is written, is this variable and no more.
bool stands_alone_in(const Json& distribution, const std::string& variable);
/// The mean of what is left within the ends.
double middle_of(const StudyDistribution& distribution);
/// Something of the distribution must lie between where it is cut off, and the nominal value within.
void check_ends(const StudyVariable& variable, Findings& findings);
/// Of distributions that design variables make: they must be such over all ranges, and have a use.
void check_formulas(const StudyFile& study, Findings& findings);

/// Reads an inequality of a probability or a reliability index, of `optimise`.
void read_probability(const Json& whole, const std::string& source, const std::string& path,
                      StudyOptimum& optimum, StudyFile& study, Findings& findings);
/// Whether an inequality is one of those.
bool asks_for_probability(const std::string& source);
/// Reads the `check` of `optimise`, a simulation of its probabilities.
void read_probability_check(const Json& whole, bool has_probabilities, StudyOptimum& optimum,
                            StudyFile& study, Findings& findings);
/// Of a study with a probability: something must be random, and something be searched.
void check_random_design(const Json& whole, const StudyOptimum& optimum, StudyFile& study,
                         Findings& findings);

/// Reads what a study is asked: `plan`, `sensitivity`, `reliability`, `optimise` and `surrogate`, of a file
/// whose variables and quantities have been read.
void read_study_task(const Json& json, StudyFile& study, Findings& findings);

}  // namespace nurbeam
