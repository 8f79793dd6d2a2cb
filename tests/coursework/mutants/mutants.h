// Mutants of a solution: small wrong changes on the level of tokens, made by rule and not by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace coursework {

struct Mutant {
  std::string rule;          // "operator", "constant", "index", "swapped name", "term left out", ...
  int line = 0;              // of the source, from 1
  std::string right, wrong;  // the lines that differ, without what is around them
  std::string source;        // all of it, with the change
};

/// Of each rule up to `most`, spread over the source. Some do not compile, as whoever builds them finds out; no two are
/// the same.
std::vector<Mutant> mutants_of(const std::string& source, std::size_t most);

/// A mutant that no test can see, and why: of equivalent.txt.
struct Equivalent {
  std::string where;         // "a1-steppers euler.cpp"
  std::string right, wrong;  // as in Mutant
  std::string why;
};

/// Paragraphs `[where]`, then for each `- right`, `+ wrong`, `why`. Throws InputError that names file and line.
std::vector<Equivalent> read_equivalents(const std::filesystem::path& file);

}  // namespace coursework
