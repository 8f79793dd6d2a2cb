// The keys of a scene file.
#pragma once

#include <span>

#include "mysim/keys.h"

namespace crosscheck {

/// Every key that a scene file may have, what stands there, and which ones it must have.
std::span<const Key> scene_keys();

}  // namespace crosscheck
