#pragma once
#include <filesystem>
#include <string>

namespace nurbeam {

/// A program that belongs to nurbeam and does a part of its work in a process of its own: that named by an
/// environment variable, or where it is not set beside this program, in ../libexec/nurbeam from there, where
/// nurbeam was installed, or in the build tree.
struct CompanionProgram {
  std::string name;      ///< nurbeam-cad
  std::string purpose;   ///< "reads and writes CAD files", for the message
  std::string variable;  ///< NURBEAM_CAD
  std::string folder;    ///< of the build tree

  /// Throws std::runtime_error that names these places when it is in none, or the variable where it
  /// names no file.
  std::filesystem::path find() const;
};

/// nurbeam-cad, which alone knows OpenCASCADE.
std::filesystem::path cad_program();
/// nurbeam-study, which alone knows OpenTURNS and MPI.
std::filesystem::path study_program();

}  // namespace nurbeam
