#pragma once
/// Shared libraries of the operating system, for module_loader.cpp. Internal.

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille {

/// The file name of a module: lib<prefix>.so, or <prefix>.dll on Windows.
std::string library_name(const std::string& prefix);

/// The folders in which modules are searched for, in order. \param own see own_folder()
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own);

/// Opens a library. Throws Error (failure) with the system's reason.
void* open_library(const std::filesystem::path& file);

/// The address of an exported function; null if there is none.
void* find_symbol(void* library, const std::string& name);

}  // namespace quadrille
