#pragma once
/// An X display to draw on, which Debian's VTK needs even off screen.

#include <sys/types.h>

#include <optional>
#include <string>

namespace quadrille {

/// During its lifetime, DISPLAY names a display to draw on: an Xvfb of its own (package xvfb), so that
/// pictures are the same with and without a screen, or the user's display if Xvfb cannot be started.
class XDisplay {
 public:
  XDisplay();
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;

  /// Why there is no display, as one sentence; empty when there is.
  const std::string& problem() const { return problem_; }

 private:
  bool start_server();

  pid_t server_ = -1;
  std::optional<std::string> old_display_;
  std::string problem_;
};

}  // namespace quadrille
