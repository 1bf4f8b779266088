#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "fem/motion/record/checkpoint.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// What the status of a run begins with whose errors are not as small as was asked.
inline constexpr const char* accuracy_status = "accuracy";

/// What a restart point belongs to, as a digest: the program, the case with its overrides, the CAD files.
std::string digest_of_inputs(const CaseFile& c, const BuiltModel& built);

/// The restart point of a directory.
std::filesystem::path restart_file(const std::filesystem::path& directory);

/// A restart point that cannot be used.
struct UnusableCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The restart point of a directory, if it belongs to these inputs. Throws UnusableCheckpoint.
Checkpoint find_checkpoint(const std::filesystem::path& directory, const std::string& inputs);

/// The end of a finished run of these inputs, from which its errors can be found without running it again;
/// nothing where the case does not ask for errors, or there is none.
std::optional<Checkpoint> finished_before(const CaseFile& c, const std::filesystem::path& directory,
                                          const std::string& inputs);

}  // namespace nurbeam
