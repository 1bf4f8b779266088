#include "pipelines/command/companion.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace nurbeam {

void become_program(const std::filesystem::path& program, std::vector<std::string> words) {
  words.insert(words.begin(), program.string());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  throw std::runtime_error(words[0] + " cannot be started: " + std::strerror(errno));
}

}  // namespace nurbeam
