#pragma once
/// What the system lets this process do with files and folders.

#include <filesystem>
#include <string>

namespace quadrille {

/// Why the file or folder cannot be read, in the system's words; empty where it can be. Opens nothing: a pipe
/// may be asked about.
std::string why_unreadable(const std::filesystem::path& path);

/// Why no file can be made in the folder, in the system's words; empty where one can be.
std::string why_unwritable(const std::filesystem::path& folder);

}  // namespace quadrille
