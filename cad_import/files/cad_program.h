#pragma once
#include <filesystem>

namespace nurbeam {

/// The program nurbeam-cad, which alone knows OpenCASCADE: that named by the environment variable
/// NURBEAM_CAD, or else beside this program, in ../libexec/nurbeam from there, where nurbeam was installed,
/// or in the build tree. Throws std::runtime_error that names these places when it is in none.
std::filesystem::path cad_program();

}  // namespace nurbeam
