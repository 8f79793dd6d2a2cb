// Blessed speeds: what each method cost beside the plain loop when somebody last said that this is right. One file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/lines.h"
#include "experiments/regress/speed.h"

namespace crosscheck {

/// The kind of machine and program that a speed belongs to: on another kind it says nothing, for what a method takes
/// beside the plain loop depends on the processor's units and caches and on the compiler.
struct Machine {
  std::string cpu, compiler;  // processor_kind() (machine.h), empty where that is not known; with its flags
  std::string yardstick;      // which plain loop
  bool operator==(const Machine&) const = default;
};

struct BlessedSpeed {
  std::string scene, hash, method;  // hash: of the scene
  double ratio = 0;                 // CPU time over the plain loop's: the middle of some measurements apart in time
  double spread = 0;                // relative: how far the second farthest of these is from the middle
  Machine machine;
  int blessing = 1;  // its number in the file, from 1
};

struct SpeedFile {
  std::vector<Blessing> blessings;
  std::vector<BlessedSpeed> speeds;  // of several kinds of machine side by side
};

/// The question's speed on that kind of machine, or null; no kind is like one that is not known.
const BlessedSpeed* find_speed(const SpeedFile& file, const SpeedQuestion& question, const Machine& machine);

/// speed-cost.csv in the folder.
std::filesystem::path speed_file_in(const std::filesystem::path& folder);
std::string text_of(const SpeedFile& file);
/// Throws InputError "FILE:LINE: expected ..."; nothing where there is no file.
std::optional<SpeedFile> read_speed_file(const std::filesystem::path& folder);

}  // namespace crosscheck
