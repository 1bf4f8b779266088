#pragma once
#include <chrono>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace nurbeam {

/// With good files: a busy machine gives a process in the background a small share of its time.
inline constexpr std::chrono::seconds patience{1800};

/// A file that can be read, and how much comes of it.
struct CorpusText {
  std::string name, content;
  std::size_t curves, diagnostics;
};

/// The files of a format (step, iges, dxf, binary, ifc, brep, json, packed) among those of the tests, and in
/// the folder `from` unless it is empty, the smallest first. Throws std::runtime_error where there is none.
std::vector<CorpusText> corpus_of(const std::string& format, const std::string& from);

/// A small file four times as often as one of four times its size: a case should cost little.
const CorpusText& random_text(const std::vector<CorpusText>& corpus, std::mt19937_64& random);

}  // namespace nurbeam
