#pragma once
/// Text for Windows' functions, which take UTF-16, where ours is UTF-8. Internal, in the files for Windows
/// alone.

#include <filesystem>
#include <string>
#include <system_error>

namespace quadrille {

inline std::wstring wide(const std::string& text) {
  return std::filesystem::path(text).wstring();
}

/// The system's message for an error number of GetLastError().
inline std::string windows_message(unsigned long number) {
  std::string text = std::system_category().message(static_cast<int>(number));
  while (!text.empty() && (text.back() == '.' || text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

}  // namespace quadrille
