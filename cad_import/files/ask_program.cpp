#include "cad_import/files/ask_program.h"

#include <stdexcept>

#include "cad_import/files/companion_program.h"

namespace nurbeam {

ChildResult asked(const CadRequest& request, const ChildLimits& limits) {
  try {
    return run_program(cad_program(), to_bytes(request), limits);
  } catch (const std::runtime_error& missing) {
    return {ChildResult::Status::not_started, "", missing.what()};
  }
}

}  // namespace nurbeam
