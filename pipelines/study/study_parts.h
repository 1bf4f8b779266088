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

/// Reads what a study is asked: `plan`, `sensitivity`, `reliability`, `optimise` and `surrogate`, of a file
/// whose variables and quantities have been read.
void read_study_task(const Json& json, StudyFile& study, Findings& findings);

}  // namespace nurbeam
