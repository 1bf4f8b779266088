#include "pipelines/command/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <new>
#include <ostream>

#include "pipelines/command/manual.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

template <class Item>
const Item& find_by_name(const std::vector<Item>& items, const std::string& name, const char* what) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  if (found == items.end())
    throw UsageError(std::string("unknown ") + what + " " + in_quotes(name) +
                     known_names(name, names_of(items)));
  return *found;
}

// The name of the first argument: "IN.step" of "IN.step...", "CASE.json" of "CASE.json OUT".
std::string first_name(const std::string& arguments) {
  const std::string first = arguments.substr(0, arguments.find(' '));
  return first.substr(0, first.find("..."));
}

// The files in the present folder that an argument may be.
std::string files_here(const std::string& argument) {
  constexpr std::size_t most = 20;
  if (!argument.ends_with(".json")) return "";
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(".", ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().filename().string());
  if (names.empty()) return "; there is no .json file in this folder";
  std::sort(names.begin(), names.end());
  if (names.size() > most) names.resize(most);
  return "; in this folder there are: " + quoted_list(names);
}

// Whether a word is a value of an option that may stand without one.
bool is_value(const std::string& word) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return !word.empty() && is_digit(word.front()) && (is_digit(word.back()) || word.back() == '%');
}

// The words of a command, in which every option that may stand without a value has one.
std::vector<std::string> with_values(const Command& command, std::vector<std::string> words) {
  const auto is_bare = [&](const std::string& word) {
    return std::ranges::any_of(command.options, [&](const CommandOption& option) {
      return option.may_be_bare && option.name == word;
    });
  };
  for (std::size_t i = 0; i < words.size(); ++i)
    if (is_bare(words[i]) && (i + 1 == words.size() || !is_value(words[i + 1]))) words[i] += "=true";
  return words;
}

// The parser of one command, and what it has read.
class Parser {
 public:
  explicit Parser(const Command& command) : command_(command) {
    app_.set_help_flag();
    app_.allow_extras();
    app_.add_option("arguments", positional_)->expected(0, CLI::detail::expected_max_vector_size);
    values_.resize(command.options.size());
    for (std::size_t i = 0; i < command.options.size(); ++i) {
      const CommandOption& option = command.options[i];
      if (option.value.empty())
        app_.add_flag(option.name)->disable_flag_override();
      else
        app_.add_option(option.name, values_[i])->allow_extra_args(false)->take_all();
    }
  }

  Arguments parse(const std::vector<std::string>& given) {
    const std::vector<std::string> words = with_values(command_, given);
    try {
      app_.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the back
    } catch (const CLI::ArgumentMismatch& error) {
      throw UsageError(complaint(words, error));
    }
    for (const std::string& extra : app_.remaining())
      if (extra.starts_with("-")) find_by_name(command_.options, extra.substr(0, extra.find('=')), "option");
    return arguments();
  }

 private:
  // CLI11 tells that a value is missing, or one too many, but not as a value of its own of which option.
  std::string complaint(const std::vector<std::string>& words, const CLI::ArgumentMismatch& error) const {
    for (const CommandOption& option : command_.options) {
      const bool is_last = !words.empty() && words.back() == option.name;
      if (!option.value.empty() && is_last) return "the option " + option.name + " needs a value";
      const bool has_value = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return word.starts_with(option.name + "=");
      });
      if (option.value.empty() && has_value) return "the option " + option.name + " takes no value";
    }
    return error.what();
  }

  Arguments arguments() const {
    Arguments arguments{.positional = positional_, .options = {}};
    for (std::size_t i = 0; i < command_.options.size(); ++i) {
      const CommandOption& option = command_.options[i];
      if (app_.count(option.name) > 0)
        arguments.options[option.name] = values_[i];
      else if (option.required)
        throw UsageError("the option " + option.name + " is missing");
    }
    if (positional_.empty() && command_.min_positional > 0)
      throw UsageError("no " + first_name(command_.positional) + " is given" +
                       files_here(command_.positional));
    if (positional_.size() < command_.min_positional || positional_.size() > command_.max_positional)
      throw UsageError("has " + std::to_string(positional_.size()) +
                       (positional_.size() == 1 ? " argument" : " arguments") +
                       " besides its options; expected " + command_.positional);
    return arguments;
  }

  const Command& command_;
  CLI::App app_;
  std::vector<std::string> positional_;
  std::vector<std::vector<std::string>> values_;
};

bool asks_for_help(const std::string& word) { return word == "--help" || word == "-h"; }

int run_command_by_name(const std::vector<Command>& table, const std::vector<std::string>& words,
                        Streams streams) {
  const Command& command = find_by_name(table, words[0], "command");
  if (std::any_of(words.begin(), words.end(), asks_for_help)) {
    streams.out << usage_of(command) << "\n  " << command.help << '\n';
    for (const CommandOption& option : command.options)
      streams.out << "    " << option.name << (option.value.empty() ? "" : " " + option.value) << ": "
                  << option.help << '\n';
    return exit_done;
  }
  const auto fail = [&](int code, const std::exception& error) {
    streams.err << "error: " << error.what() << '\n';
    return code;
  };
  try {
    return command.run(Parser(command).parse({words.begin() + 1, words.end()}), streams);
  } catch (const UsageError& error) {
    streams.err << "error: nurbeam " << command.name << ": " << error.what()
                << "\nusage: " << brief_usage_of(command) << "; nurbeam " << command.name
                << " --help has more\n";
    return exit_bad_input;
  } catch (const std::invalid_argument& error) {
    return fail(exit_bad_input, error);
  } catch (const std::filesystem::filesystem_error& error) {
    streams.err << "error: " << error.path1().string() << ": " << error.code().message() << '\n';
    return command.failure;
  } catch (const std::bad_alloc&) {
    streams.err << "error: there is not enough memory; free some, or use fewer elements\n";
    return command.failure;
  } catch (const std::exception& error) {
    return fail(command.failure, error);
  }
}

int run_words(const std::vector<Command>& table, const std::vector<std::string>& words, Streams streams) {
  if (words.empty()) {
    streams.err << help_text(table);
    return exit_bad_input;
  }
  if (asks_for_help(words[0]) || words[0] == "help") {
    streams.out << help_text(table);
    return exit_done;
  }
  if (words[0] == "--version") {
    streams.out << "nurbeam " NURBEAM_VERSION "\n";
    return exit_done;
  }
  try {
    return run_command_by_name(table, words, streams);
  } catch (const UsageError& error) {
    streams.err << "error: " << error.what() << "\nnurbeam --help lists the commands\n";
    return exit_bad_input;
  }
}

}  // namespace

int run_command_line(const std::vector<Command>& table, const std::vector<std::string>& arguments,
                     std::ostream& out, std::ostream& err) {
  const int code = run_words(table, arguments, {out, err});
  out.flush();
  if (!out) {
    err << "error: standard output cannot be written\n";
    return exit_not_written;
  }
  return code;
}

int run_command_line(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  return run_command_line(commands(), arguments, out, err);
}

}  // namespace nurbeam
