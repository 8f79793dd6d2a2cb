// gnuplot, and whether what it wrote is whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crosscheck {

/// Runs gnuplot, without anybody's own settings, on a script in `folder`, which must leave these files there. Returns
/// what it warned of; a warning is no failure. Throws std::runtime_error that begins with `what` when gnuplot fails, or
/// a file is missing, empty or cut off.
std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder,
                        const std::vector<std::string>& files, const std::string& what);

/// Says on stderr, on a line each, what gnuplot warned of while it drew `what`; nothing where it did not.
void tell_warnings(const std::string& warnings, const std::string& what);

}  // namespace crosscheck
