// Processor cores: how many this process may use, and keeping to one of them.
#pragma once

namespace crosscheck {

/// As the affinity mask says, which batch systems and `taskset` set.
int cores_allowed();
/// Keeps the calling process to the last core that it may use, so that its caches stay warm. Best effort.
void pin_to_one_core();

}  // namespace crosscheck
