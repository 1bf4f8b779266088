#include "pipelines/command/manual.h"

#include <sstream>

namespace nurbeam {

namespace {

// Roff reads "-" as a hyphen and a leading "." as a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '-' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

const char* const exit_codes =
    "0 done, 1 a comparison or verification failed, 2 bad input, 3 the solver did not converge,\n"
    "            4 results could not be written, 130 interrupted";

}  // namespace

std::string brief_usage_of(const Command& command) {
  std::string usage = "nurbeam " + command.name;
  if (!command.positional.empty()) usage += " " + command.positional;
  bool has_others = false;
  for (const CommandOption& option : command.options)
    if (option.required)
      usage += " " + option.name + " " + option.value;
    else
      has_others = true;
  return usage + (has_others ? " [options]" : "");
}

std::string usage_of(const Command& command) {
  std::string usage = "nurbeam " + command.name;
  if (!command.positional.empty()) usage += " " + command.positional;
  for (const CommandOption& option : command.options) {
    const std::string text = option.name + (option.value.empty() ? "" : " " + option.value);
    usage += " " + (option.required ? text : "[" + text + "]") + (option.repeated ? "..." : "");
  }
  return usage;
}

std::string manual_page(const std::vector<Command>& commands) {
  std::ostringstream page;
  page << ".TH NURBEAM 1 \"\" \"nurbeam " NURBEAM_VERSION
          "\"\n.SH NAME\nnurbeam \\- CAD curves to flexible "
          "beams with sliding joints, and back\n.SH SYNOPSIS\n";
  for (const Command& command : commands) page << ".br\n" << roff(usage_of(command)) << "\n";
  page << ".SH COMMANDS\n";
  for (const Command& command : commands) {
    page << ".SS " << roff(command.name) << "\n" << roff(command.help) << "\n";
    for (const CommandOption& option : command.options)
      page << ".TP\n.B " << roff(option.name + (option.value.empty() ? "" : " " + option.value)) << "\n"
           << roff(option.help) << "\n";
  }
  page << ".SH EXIT STATUS\n" << roff(exit_codes) << "\n";
  page
      << ".SH ENVIRONMENT\n.TP\n.B NURBEAM_CAD\nThe program that reads and writes CAD files, where it is not "
         "installed beside nurbeam.\n";
  return page.str();
}

std::string bash_completion(const std::vector<Command>& commands) {
  std::ostringstream script;
  script << "_nurbeam() {\n  local word=${COMP_WORDS[COMP_CWORD]} options=\n  if ((COMP_CWORD == 1)); then\n"
            "    COMPREPLY=($(compgen -W '--help --version";
  for (const Command& command : commands) script << ' ' << command.name;
  script << "' -- \"$word\"))\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n";
  for (const Command& command : commands) {
    script << "    " << command.name << ") options='--help";
    for (const CommandOption& option : command.options) script << ' ' << option.name;
    script << "' ;;\n";
  }
  script << "  esac\n  if [[ $word == -* ]]; then\n    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
            "  else\n    COMPREPLY=($(compgen -f -- \"$word\"))\n  fi\n}\n"
            "complete -o filenames -F _nurbeam nurbeam\n";
  return script.str();
}

namespace {

// Lines that a terminal of 80 columns has room for, each behind the indentation.
std::string wrapped(const std::string& words, const std::string& indentation) {
  constexpr std::size_t width = 79;
  std::istringstream stream(words);
  std::string text, line = indentation;
  for (std::string word; stream >> word;) {
    const bool is_first = line.size() == indentation.size();
    if (!is_first && line.size() + 1 + word.size() > width) {
      text += line + "\n";
      line = indentation + word;
    } else {
      line += (is_first ? "" : " ") + word;
    }
  }
  return text + line + "\n";
}

}  // namespace

std::string help_text(const std::vector<Command>& commands) {
  std::ostringstream text;
  text << "nurbeam " NURBEAM_VERSION
          ": CAD curves to flexible beams with sliding joints, and back\n\n"
          "A first result: nurbeam inspect CURVE.step, nurbeam check CASE.json,\n"
          "nurbeam run CASE.json; docs/getting-started.md shows the three.\n\n";
  for (const Command& command : commands)
    text << "  " << brief_usage_of(command) << "\n" << wrapped(command.help, "      ");
  text << "\nnurbeam COMMAND --help: the options of a command\n"
       << wrapped(std::string("Exit codes: ") + exit_codes, "");
  return text.str();
}

}  // namespace nurbeam
