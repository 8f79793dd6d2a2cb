// Small wrong changes to mysim, as texts: what is right in a file, and what stands there instead.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

struct Mutation {
  std::string name, file;           // file: in the folder mysim
  std::vector<std::string> causes;  // what may be named as the cause; nothing else may
  std::string right, wrong;         // an expression, or statements that end in ';'
};

/// Throws InputError "FILE:LINE: expected ...".
std::vector<Mutation> read_mutations(const std::filesystem::path& file);

}  // namespace crosscheck
