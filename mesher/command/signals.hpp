#pragma once
/// What CancelOnSignal needs of the operating system: Ctrl-C and an alarm. Internal.

#include <string>

#include "geometry/base/execution_context.hpp"

namespace quadrille::command {

/// From now on Ctrl-C cancels the context's work. \param delivers_part see CancelOnSignal
void watch_signals(ExecutionContext& context, bool delivers_part);
void stop_watching_signals();

/// Rings once after that many seconds, in place of an earlier alarm; 0 = never. The first alarm gives the
/// work a moment to end by itself, the next one ends the process with the line of set_alarm_line().
void ring_after(double seconds);

/// \param line with its line break
void set_alarm_line(const std::string& line);

}  // namespace quadrille::command
