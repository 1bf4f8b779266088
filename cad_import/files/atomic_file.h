#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// The name under which `file` is written before it is complete.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Gives what was written under temporary_name(file) its own name once it is on the disk: whoever opens
/// `file` sees it whole or not at all, also after a crash of the machine. Throws std::runtime_error (file and
/// reason); the temporary file is gone then.
void publish(const std::filesystem::path& file);

/// Writes a text so; nothing, or a Diagnostic of severity error with the reason.
[[nodiscard]] std::vector<Diagnostic> write_at_once(const std::filesystem::path& file,
                                                    const std::string& text);

}  // namespace nurbeam
