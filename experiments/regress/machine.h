// What kind of processor this is: speeds are compared on one kind only.
#pragma once

#include <filesystem>
#include <string>

namespace crosscheck {

/// The processor in one line: its name, its family, model and stepping (which tell apart what providers of virtual
/// machines sell under one name), its sizes of cache and its instruction sets for arithmetic. From Linux's `cpuinfo`
/// (usually /proc/cpuinfo) and the folder of the first processor's caches (/sys/devices/system/cpu/cpu0/cache); what
/// these do not tell is left out. Empty where the processor cannot be told from others.
std::string processor_kind(const std::filesystem::path& cpuinfo, const std::filesystem::path& caches);

/// This machine's.
std::string processor_kind();

}  // namespace crosscheck
