#pragma once
#include <iosfwd>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipelines/case/quantity.h"
#include "pipelines/diagnostics/exit_code.h"

namespace nurbeam {

/// Arguments that do not make sense; the message says what would.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Arguments {
  std::vector<std::string> positional;
  std::map<std::string, std::vector<std::string>> options;  ///< values by name; a flag has none

  bool has(const std::string& option) const { return options.contains(option); }
  std::string value(const std::string& option, const std::string& otherwise) const {
    return has(option) ? options.at(option).back() : otherwise;
  }
  std::vector<std::string> values(const std::string& option) const {
    return has(option) ? options.at(option) : std::vector<std::string>{};
  }
};

/// A number in SI units or a text with a unit, as the value of an option; throws UsageError for neither.
double quantity_argument(const std::string& option, const std::string& text, Dimension dimension);

/// The whole number that stands as the value of an option; throws UsageError for what is none from `least` to
/// `most`.
int whole_number(const Arguments& arguments, const std::string& option, int otherwise, int least, int most);

struct Streams {
  std::ostream &out, &err;
};

struct CommandOption {
  std::string name;   ///< with its dashes
  std::string value;  ///< what stands for its value; "" for a flag
  std::string help;
  bool required = false;
  bool repeated = false;
  /// Whether it may stand without a value: a word behind it is one if it begins as a number does.
  bool may_be_bare = false;
};

/// One command of the program: parser, help, manual page and completion are made of this.
struct Command {
  std::string name;
  std::string positional;  ///< usage of what follows the name
  std::string help;
  std::size_t min_positional, max_positional;
  std::vector<CommandOption> options;
  int (*run)(const Arguments&, Streams);
  int failure = exit_bad_input;  ///< the exit code when files or the system fail
};

/// The commands of nurbeam.
const std::vector<Command>& commands();

}  // namespace nurbeam
