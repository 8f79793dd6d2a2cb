// How much memory and disk there is, and refusals of what does not fit.
#pragma once

#include <filesystem>
#include <string>

namespace crosscheck {

/// Bytes that this process can still take: what the system says is available (MemAvailable), less where a control group
/// or a limit of the process's address space allows less. Infinite where nothing is known.
double free_memory();

/// Bytes that can be written into the folder, or into the nearest one above it that is there. Infinite where nothing is
/// known.
double free_disk(const std::filesystem::path& folder);

/// For people: "3.2 GB", powers of ten.
std::string in_bytes(double bytes);

}  // namespace crosscheck
