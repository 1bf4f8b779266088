#pragma once
#include <functional>
#include <string>

namespace nurbeam {

/// The main function of a program that run_program() runs: puts itself under the limits in its arguments,
/// answers the request with what `work` makes of it, and returns the exit code. What `work` throws is sent as
/// its text.
int serve_one_request(int argc, char** argv,
                      const std::function<std::string(const std::string& request)>& work);

}  // namespace nurbeam
