#include <algorithm>
#include <cctype>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/study/analysis.h"
#include "pipelines/study/study_parts.h"

namespace nurbeam {

namespace {

const std::string example = "write it as \"probability(stress > 2.5e8) <= 1e-3\"";
constexpr const char* probability_words[] = {"reliability_index", "probability"};

/// probability(event) <= limit, in its parts.
struct ProbabilityText {
  bool is_index = false;
  std::string event, limit;
  bool at_most = true;
};

std::size_t past_spaces(const std::string& text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  return at;
}

// Behind the bracket that closes the one at `open`; nothing where none does.
std::optional<std::size_t> behind_bracket(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    depth += text[at] == '(' ? 1 : 0;
    depth -= text[at] == ')' ? 1 : 0;
    if (depth == 0) return at + 1;
  }
  return {};
}

std::optional<ProbabilityText> parts_of(const std::string& text) {
  const std::size_t begin = past_spaces(text, 0);
  for (const std::string function : probability_words) {
    if (text.compare(begin, function.size(), function) != 0) continue;
    const std::size_t open = past_spaces(text, begin + function.size());
    const auto behind = open < text.size() && text[open] == '(' ? behind_bracket(text, open) : std::nullopt;
    if (!behind) continue;
    const std::size_t sign = past_spaces(text, *behind);
    if (sign >= text.size() || (text[sign] != '<' && text[sign] != '>')) continue;
    const std::size_t limit = sign + (text.compare(sign + 1, 1, "=") == 0 ? 2 : 1);
    return ProbabilityText{function == probability_words[0], text.substr(open + 1, *behind - open - 2),
                           text.substr(limit), text[sign] == '<'};
  }
  return {};
}

/// Reads what `optimise` says of probabilities.
class ProbabilityReader : StudyPartReader {
 public:
  using StudyPartReader::StudyPartReader;

  void read(const std::string& source, const std::string& path, StudyOptimum& optimum) {
    const auto parts = parts_of(source);
    if (!parts) return findings_.error(path, in_quotes(source) + " is no limit of a probability; " + example);
    const auto event = event_of(parts->event, path);
    const auto limit = number_of(parts->limit, path);
    if (!event || !limit) return;
    const auto index =
        parts->is_index ? index_asked(*limit, *parts, path) : index_of_probability(*limit, *parts, path);
    if (!index) return;
    StudyOptimum::Probability asked{*event};
    asked.fails.text = source;
    // What must happen often fails where it does not.
    if (!parts->is_index && !parts->at_most) std::swap(asked.fails.greater, asked.fails.lesser);
    asked.least_index = *index;
    optimum.probabilities.push_back(std::move(asked));
  }

  void read_check(bool has_probabilities, StudyOptimum& optimum) {
    using Method = StudyReliability::Method;
    if (!has(json_["optimise"], "check")) return;
    if (!has_probabilities)
      findings_.error("optimise.check",
                      "has no use: nothing in \"subject_to\" is a \"probability(...)\"; leave it out");
    const Json& check = json_["optimise"]["check"];
    optimum.check = StudyReliability{
        .method = chosen<Method>(
            check, "method",
            {{"importance_sampling", Method::importance_sampling}, {"monte_carlo", Method::monte_carlo}}),
        .count = static_cast<int>(number(check, "count", 1000)),
        .coefficient_of_variation = number(check, "coefficient_of_variation", 0)};
  }

  void check_design(const StudyOptimum& optimum) {
    const auto& variables = study_.variables;
    const auto is_random = [](const StudyVariable& variable) { return variable.is_random; };
    const auto is_design = [](const StudyVariable& v) { return !v.is_random && !v.derived; };
    if (std::none_of(variables.begin(), variables.end(), is_random))
      findings_.error(
          "optimise.subject_to",
          "has a probability, but no variable has a \"distribution\"; give one to what is scattered");
    if (std::none_of(variables.begin(), variables.end(), is_design))
      findings_.error("optimise",
                      "has nothing to search: all variables have a \"distribution\"; give what is designed a "
                      "\"range\", and where it is a mean name it there, as in \"mean\": \"radius\"");
    if (optimum.objectives.size() > 1)
      findings_.error(has(json_["optimise"], "minimise") ? "optimise.minimise" : "optimise.maximise",
                      "names several quantities, but with a probability in \"subject_to\" there is one; take "
                      "one, and the others as limits in \"subject_to\"");
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (!variables[i].distribution.formulas.empty() && has(json_["variables"][i], "nominal"))
        findings_.error(child(variables[i].path, "nominal"),
                        "is fixed, but the design makes the distribution; leave it out: the variable stands "
                        "at the mean");
  }

 private:
  std::optional<StudyOptimum::Constraint> event_of(const std::string& text, const std::string& path) {
    const auto event = parsed(text, path);
    if (!event) return {};
    const auto sides = event->sides();
    if (!sides) {
      findings_.error(path, in_quotes(text) + " is no comparison, which may hold or not; " + example);
      return {};
    }
    std::vector<std::string> known = names_of(study_.variables);
    for (const StudyQuantity& quantity : study_.quantities) known.push_back(quantity.name);
    if (!check_names(*event, path, "quantity or variable", known)) return {};
    check_number(*event, path);
    return StudyOptimum::Constraint{sides->first, sides->second, ""};
  }

  std::optional<double> number_of(const std::string& text, const std::string& path) {
    const auto number = parsed(text, path);
    if (!number) return {};
    try {
      if (number->names().empty() && !number->sides()) return number->number({});
    } catch (const std::invalid_argument&) {  // it is of histories
    }
    findings_.error(path, in_quotes(text) + " is no number; " + example);
    return {};
  }

  std::optional<double> index_of_probability(double limit, const ProbabilityText& parts,
                                             const std::string& path) {
    constexpr double least = 1e-12, most = 0.5;
    const double failure = parts.at_most ? limit : 1 - limit;
    if (failure >= least && failure <= most) return index_of(failure);
    const std::string sign = parts.at_most ? "<=" : ">=", other = parts.at_most ? ">=" : "<=";
    const std::string rule = parts.at_most ? "must be from 1e-12 to 0.5" : "must be from 0.5 to 1 - 1e-12";
    findings_.error(path, "is a probability " + sign + " " + text_of(limit, all_digits) + "; the number " +
                              rule + (limit > 0 && limit < 1 ? ", or take \"" + other + "\"" : ""));
    return {};
  }

  std::optional<double> index_asked(double limit, const ProbabilityText& parts, const std::string& path) {
    constexpr double most = 7;
    if (parts.at_most) {
      findings_.error(path, "asks for a reliability index that is small; take \">=\"");
      return {};
    }
    if (limit >= 0 && limit <= most) return limit;
    findings_.error(path, "is a reliability index of " + text_of(limit, all_digits) +
                              "; must be from 0 to 7, as 3.09 of a probability of 1e-3");
    return {};
  }
};

}  // namespace

bool asks_for_probability(const std::string& source) {
  return std::any_of(
      std::begin(probability_words), std::end(probability_words),
      [&](const std::string& function) {
        const std::size_t at = source.find(function);
        if (at == std::string::npos) return false;
        const std::size_t behind = past_spaces(source, at + function.size());
        return behind < source.size() && source[behind] == '(';
      });
}

void read_probability(const Json& whole, const std::string& source, const std::string& path,
                      StudyOptimum& optimum, StudyFile& study, Findings& findings) {
  ProbabilityReader(whole, study, findings).read(source, path, optimum);
}

void read_probability_check(const Json& whole, bool has_probabilities, StudyOptimum& optimum,
                            StudyFile& study, Findings& findings) {
  ProbabilityReader(whole, study, findings).read_check(has_probabilities, optimum);
}

void check_random_design(const Json& whole, const StudyOptimum& optimum, StudyFile& study,
                         Findings& findings) {
  ProbabilityReader(whole, study, findings).check_design(optimum);
}

}  // namespace nurbeam
