// What captions say of measured times: who built what, and which times are scaled.
#pragma once

#include <string>
#include <vector>

namespace crosscheck {

/// Of the methods in a chart, by name or "ENGINE/": "mysim and odeint are compiled in this build, Bullet is Debian's
/// generic x86-64 build". Only engines that are there are named.
std::string builds_text(const std::vector<std::string>& methods);

/// The points of a chart whose time is that of a part of the run, scaled. A figure draws them as rings around the
/// markers of their methods.
inline constexpr auto scaled_times = "time scaled from a part of the run";

}  // namespace crosscheck
