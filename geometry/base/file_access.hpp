#pragma once
/// What the system lets this process do with files and folders, and what their names tell.

#include <filesystem>
#include <string>

namespace quadrille {

/// Throws Error (failure) unless the path can be read: not folders, devices, or files larger than memory has
/// room for. Opens nothing: safe for pipes.
void require_readable(const std::filesystem::path& path);

/// The system's message why no file can be created in the folder; empty if one can be.
std::string why_unwritable(const std::filesystem::path& folder);

/// The ending of a name, which determines the file's format, in lower case: ".msh" for "PART.MSH".
std::string lower_ending(const std::filesystem::path& path);

}  // namespace quadrille
