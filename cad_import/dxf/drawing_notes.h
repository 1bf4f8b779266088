#pragma once
#include <map>
#include <string>
#include <vector>

#include "cad_import/report/diagnostic.h"

namespace nurbeam {

/// What is said of the entities of a drawing: each thing once, with the number of entities it is said of.
class DrawingNotes {
 public:
  void count_not_read(const std::string& kind) { ++kinds_not_read_[kind]; }
  void add(Severity severity, const std::string& where, const std::string& message);

  /// The messages in the order of their first entities, and at last the kinds that were not read.
  std::vector<Diagnostic> diagnostics() const;

 private:
  struct Message {
    Diagnostic first;
    std::size_t count;
  };

  std::vector<Message> messages_;
  std::map<std::string, std::size_t> place_of_, kinds_not_read_;
};

}  // namespace nurbeam
