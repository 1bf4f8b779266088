#pragma once
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "pipelines/study/variant.h"

namespace nurbeam {

/// A variant as one line of text, and back. Throws std::runtime_error where the line is none.
std::string line_of(const Variant& variant);
Variant variant_of(const std::string& line);

/// What keeps rows from being written or read: the file and the reason.
struct StudyRowsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Rows that are there cannot be gone on with: they belong to another study, or are damaged.
struct UnusableRowsError : StudyRowsError {
  using StudyRowsError::StudyRowsError;
};

/// What rows belong to.
struct StudyIdentity {
  std::string digest;                        ///< of all of it
  std::map<std::string, std::string> parts;  ///< digests by name: of keys of the study, its case, files
};

/// The program, the study, its case with what both change, the files that it reads; null without a case.
StudyIdentity identity_of(const StudyFile& study, const StudyCase* study_case);

/// The finished variants of a study in a file, one line each, appended as they come: what was written stays
/// whatever ends the program. Behind each line stands its checksum, which is also that of its study.
/// Everything that fails throws StudyRowsError.
class StudyRows {
 public:
  /// Begins anew, or goes on where `resume`: then the file must belong to the same study, by its digest, and
  /// all lines have their checksums, else it throws UnusableRowsError; a last line that is not whole is cut
  /// off.
  StudyRows(std::filesystem::path file, const StudyIdentity& study, bool resume);
  StudyRows(const StudyRows&) = delete;
  ~StudyRows();

  /// What is already there, by number.
  const std::map<std::size_t, Variant>& stored() const { return stored_; }
  void append(const Variant& variant);
  /// Waits until all that was appended is on the disk.
  void synchronise();

 private:
  StudyRows(std::filesystem::path file, std::string study)
      : file_(std::move(file)), study_(std::move(study)) {}
  void read_back(const StudyIdentity& study);
  void check_head(const std::string& line, const StudyIdentity& study) const;
  void cut_to_size();
  void write(const std::string& line);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  std::string study_;  ///< its digest
  int descriptor_ = -1;
  long long size_ = 0;  ///< of whole lines [bytes]
  double last_synchronised_ = 0;
  std::map<std::size_t, Variant> stored_;
};

}  // namespace nurbeam
