// The keys of a scene file.
#pragma once

#include <span>

#include "mysim/keys.h"

namespace crosscheck {

/// The most samples that a run may have.
constexpr int most_samples = 1000000;

/// Every key that a scene file may have, what stands there, and which ones it must have.
std::span<const Key> scene_keys();

}  // namespace crosscheck
