/// Starts the program `quadrille` with the name of the work, in a job that limits its memory and ends it with
/// this process, and reads its answer from a pipe.

#include <windows.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/isolated_answer.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/windows_text.hpp"

namespace quadrille {

namespace {

/// A handle that is closed at the end.
class OwnedHandle {
 public:
  explicit OwnedHandle(HANDLE handle = nullptr) : handle_(handle) {}
  OwnedHandle(OwnedHandle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  OwnedHandle& operator=(OwnedHandle&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  OwnedHandle(const OwnedHandle&) = delete;
  OwnedHandle& operator=(const OwnedHandle&) = delete;
  ~OwnedHandle() { close(); }
  operator HANDLE() const { return handle_; }
  void close() {
    if (handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE) ::CloseHandle(handle_);
    handle_ = nullptr;
  }

 private:
  HANDLE handle_;
};

Error no_process(const std::string& name) {
  return failure(name, fmt::format("{}: cannot be processed in a child process: {}", name,
                                   windows_message(::GetLastError())));
}

/// One argument as CommandLineToArgvW takes it apart: backslashes count double before quotes alone.
std::wstring quoted(const std::wstring& argument) {
  std::wstring result = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t letter : argument) {
    if (letter == L'"') result.append(backslashes + 1, L'\\');
    backslashes = letter == L'\\' ? backslashes + 1 : 0;
    result += letter;
  }
  result.append(backslashes, L'\\');
  return result + L"\"";
}

std::wstring command_line(const std::filesystem::path& program, const IsolatedTask& task) {
  std::wstring line = quoted(program.wstring()) + L" isolated " + quoted(wide(task.name));
  for (const std::string& argument : task.arguments) line += L" " + quoted(wide(argument));
  return line;
}

/// All processes in it end when this handle is closed, thus also when this process is killed.
OwnedHandle make_job(std::size_t memory) {
  OwnedHandle job(::CreateJobObjectW(nullptr, nullptr));
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags =
      JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
  if (memory > 0) {
    limits.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
    limits.ProcessMemoryLimit = memory;
  }
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

/// A child in its job. The destructor ends it.
struct Child {
  OwnedHandle job, process, heard;

  Child() = default;
  Child(Child&&) = default;
  Child& operator=(Child&&) = default;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process == nullptr) return;
    ::TerminateProcess(process, 1);
    ::WaitForSingleObject(process, INFINITE);
  }
};

Child start(const IsolatedWork& options) {
  const std::filesystem::path program = own_folder() / "quadrille.exe";
  std::wstring line = command_line(program, options.task);
  SECURITY_ATTRIBUTES inherited{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  HANDLE read_end = nullptr, write_end = nullptr;
  if (!::CreatePipe(&read_end, &write_end, &inherited, 1 << 16)) throw no_process(options.subject);
  Child child;
  child.heard = OwnedHandle(read_end);
  const OwnedHandle told(write_end);
  ::SetHandleInformation(read_end, HANDLE_FLAG_INHERIT, 0);
  const OwnedHandle nothing(::CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE,
                                          FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0,
                                          nullptr));
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = nothing;
  startup.hStdOutput = told;
  startup.hStdError = nothing;
  child.job = make_job(options.memory);
  PROCESS_INFORMATION made{};
  if (!::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                        CREATE_NO_WINDOW | CREATE_SUSPENDED, nullptr, nullptr, &startup, &made))
    throw no_process(options.subject);
  child.process = OwnedHandle(made.hProcess);
  const OwnedHandle thread(made.hThread);
  ::AssignProcessToJobObject(child.job, child.process);
  ::ResumeThread(thread);
  return child;
}

/// Everything that the child writes until it ends.
std::string listen(const Child& child, const IsolatedWork& options) {
  constexpr DWORD interval = 20;  // milliseconds
  std::vector<char> chunk(1 << 16);
  std::string bytes;
  const auto start = std::chrono::steady_clock::now();
  for (bool ended = false;;) {
    DWORD waiting = 0, count = 0;
    if (::PeekNamedPipe(child.heard, nullptr, 0, nullptr, &waiting, nullptr) && waiting > 0) {
      const DWORD most = std::min<DWORD>(waiting, static_cast<DWORD>(chunk.size()));
      if (!::ReadFile(child.heard, chunk.data(), most, &count, nullptr)) return bytes;
      bytes.append(chunk.data(), count);
    } else if (ended) {
      return bytes;
    } else {
      ended = ::WaitForSingleObject(child.process, interval) == WAIT_OBJECT_0;
    }
    if (options.context != nullptr) options.context->report(options.stage, 0);
    const std::chrono::duration<double> past = std::chrono::steady_clock::now() - start;
    if (options.time_limit > 0 && past.count() > options.time_limit)
      throw failure(options.subject, options.too_long);
  }
}

}  // namespace

std::string run_in_child(const IsolatedWork& options, const std::function<void(std::ostream&)>& work) {
  if (options.context != nullptr) options.context->check();
  if (options.task.name.empty()) {
    std::ostringstream out;
    write_answer(options.subject, work, out);
    return result_of(options, std::move(out).str());
  }
  const Child child = start(options);
  return result_of(options, listen(child, options));
}

}  // namespace quadrille
