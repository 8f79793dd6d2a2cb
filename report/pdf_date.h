// The date that gnuplot's cairo writes into a PDF.
#pragma once

#include <filesystem>

namespace crosscheck {

/// Sets the one date in a PDF that Debian's cairo writes (it knows no SOURCE_DATE_EPOCH) to 1970, so that two runs
/// write the same bytes; its length stays, and with it all offsets. Throws InputError when the file cannot be written.
void undate(const std::filesystem::path& pdf);

}  // namespace crosscheck
