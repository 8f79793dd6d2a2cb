// The lanes that there are, for the table in lane.cpp.
#pragma once

#include <memory>

#include "tests/coursework/grader/lane.h"

namespace coursework {

/// Bubblewrap: namespaces of its own.
std::unique_ptr<Lane> bwrap_lane();
/// Another user per run, for root in a container that forbids namespaces.
std::unique_ptr<Lane> uid_lane();
/// Limits and the filter of system calls only.
std::unique_ptr<Lane> bare_lane();

}  // namespace coursework
