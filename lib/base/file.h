// Whole text files: read with a clear error, written under a temporary name and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gainsmith {

/// The bytes of a file, or of standard input for "-". A pipe gives what it gave at first.
/// InputError when it cannot be read (missing, a directory, no permission).
std::string read_text(const std::filesystem::path& path);

/// Writes `text` beside `path` under a temporary name, flushes it to the disk and renames it over
/// `path`: a reader sees the old file or the whole new one. InputError when that cannot be done;
/// then nothing is left behind. A link stays, and the file that it leads to is replaced. A device,
/// a pipe, a socket or an open file of this process (/dev/stdout) is written directly.
void write_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace gainsmith
