#pragma once
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "pipelines/papers/plot.h"

namespace nurbeam::papers {

/// One row of the table at the head of the page: what became of an item of a paper.
struct Status {
  std::string item, where, verdict, error;
};

/// A page in Markdown with its figures: DIR/papers.md and DIR/images/papers/*.svg. Figures are written as
/// they are added, the page by write(). Throws std::runtime_error (file and reason) when a file cannot be
/// written.
class Page {
 public:
  explicit Page(std::filesystem::path directory);

  void heading(const std::string& words, int level = 2);
  void paragraph(const std::string& words);
  /// A table under a statement of how it was computed.
  void table(const std::string& statement, const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  /// A figure over a statement of how it was computed; `name` without extension.
  void figure(const std::string& name, const Plot& plot, const std::string& statement);
  /// The table of all items stands where this is called.
  void place_status();
  void status(const Status& row) { statuses_.push_back(row); }
  void write() const;

 private:
  std::filesystem::path directory_;
  std::string head_;  // what stands before the table of items
  std::ostringstream text_;
  std::vector<Status> statuses_;
};

/// With the given significant digits; "-" if not finite.
std::string number(double value, int digits = 3);

}  // namespace nurbeam::papers
