// check --hunt: random scenes until a time is over, and a report for each fault that they show.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/check/hunt.h"
#include "experiments/sweep/store.h"

namespace crosscheck {

/// A picture (PNG) of the methods' runs of a scene on which they break a relation, at the time when they do (s; none:
/// the end). Returns why there is none; empty where it was drawn.
std::string draw_break(const std::vector<Method>& methods, const Scene& scene, std::optional<double> since,
                       const std::filesystem::path& file);

struct HuntOptions {
  Hunt hunt;
  double seconds = 0;  // no case is begun later
  std::string shard;   // I/N, or empty: all
  int jobs = 0;        // processes at a time; 0: one per core
  std::filesystem::path out;
  std::string known_file;    // as given; empty: the list that comes with Crosscheck
  std::string command_line;  // as given
  bool received = false;     // the methods come from a folder: no program among them may be run
};

/// Goes on after the last case that the folder holds. 1 where something is broken that is not known, where a case could
/// not be finished, and where nothing could be asked; else 0.
int hunt_command(const HuntOptions& options);

// Shards of a hunt, joined.

/// Whether a folder's plan is a hunt's.
bool is_hunt(const PointList& plan);
/// The findings of all cases in the folders, each case once, as one hunt of them all would have written them. Throws
/// InputError where the folders are of different hunts.
int merge_hunts(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out,
                const std::string& command_line);

}  // namespace crosscheck
