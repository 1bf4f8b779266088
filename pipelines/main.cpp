#include <iostream>

#include "pipelines/command_line.h"

int main(int count, char** words) {
  return nurbeam::run_command_line({words + 1, words + count}, std::cout, std::cerr);
}
