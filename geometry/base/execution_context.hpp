#pragma once
/// Progress, cancellation, thread count and stage times of one piece of long work.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

/// The stages of a run, in order. Reports list seconds by stage, and progress names the current stage. Within
/// `mesh` the faces are triangulated, recombined and improved, several at once.
enum class Stage {
  read,
  midsurface,
  size,
  sample,
  mesh,
  triangulate,
  color,
  recombine,
  improve,
  slide,
  assemble,
  write
};

inline constexpr std::array<std::string_view, 12> stage_names{
    ///< indexed by Stage
    "read",  "midsurface", "size",    "sample", "mesh",     "triangulate",
    "color", "recombine",  "improve", "slide",  "assemble", "write"};

/// The name of a stage in progress and reports.
inline std::string_view name_of(Stage stage) {
  return stage_names[static_cast<std::size_t>(stage)];
}

/// Passed by reference through every stage. Thread-safe. Stages check for cancellation at least once per face
/// and every few milliseconds of work.
class ExecutionContext {
 public:
  /// Called with a stage's name and the fraction of all work done, in [0, 1], which never decreases.
  /// Returning false cancels the work. Calls are serialized, on whichever thread does the work. During a long
  /// stage the same values are repeated, twenty times a second at most by default (see ask_every()).
  using Progress = std::function<bool(std::string_view stage, double fraction)>;

  ExecutionContext() = default;
  /// \param threads number of threads to use; 0 = all cores.
  explicit ExecutionContext(int threads, Progress progress = {})
      : threads_(threads), progress_(std::move(progress)) {}

  /// A share of the work of another context, which must outlive the share. Progress, cancellation and stage
  /// times are those of the other context. Checks are counted per share; its own time limit applies as well.
  explicit ExecutionContext(ExecutionContext& whole) : threads_(whole.threads_), whole_(&whole) {}

  /// The subject of the Error that ends work at its time limit.
  static constexpr const char* time_subject = "time_limit";
  /// The subject of the Error that ends a share at its limit of checks.
  static constexpr const char* work_subject = "work";

  int threads() const noexcept { return threads_; }  ///< number of threads to use; 0 = all cores

  /// Ends the work with an Error (failure, work_subject) at the first check beyond this number of checks.
  void limit_work(std::int64_t checks) noexcept { most_checks_ = checks; }
  /// The number of checks so far: a measure of work that is the same in every run.
  std::int64_t work() const noexcept { return checks_; }

  bool has_time_limit() const noexcept { return limit_seconds_ > 0; }  ///< whether one was set
  double time_limit() const noexcept { return limit_seconds_; }        ///< seconds; 0 = none
  /// Seconds until the time limit; infinite without one.
  double seconds_left() const {
    if (limit_seconds_ <= 0) return std::numeric_limits<double>::infinity();
    return std::chrono::duration<double>(deadline_ - std::chrono::steady_clock::now()).count();
  }
  /// Removes the time limit, so that the results of work that it has ended can still be processed.
  void lift_time_limit() noexcept { limit_seconds_ = 0; }

  /// The least time between two calls of the progress function from check(); 0 = call it at every check.
  void ask_every(std::chrono::milliseconds interval) noexcept { interval_ = interval.count(); }

  /// Sets the stages to come, over which progress is computed. The default is the stages of mesh().
  void expect(std::vector<Stage> stages) {
    const std::lock_guard lock(mutex_);
    expected_ = std::move(stages);
  }

  /// Ends the work with an Error (failure, time_subject) at the first check more than `seconds` from now.
  void limit_time(double seconds) {
    limit_seconds_ = seconds;
    deadline_ =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(seconds));
  }

  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }  ///< requests cancellation
  bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }  ///< requested?

  /// Throws Error: cancelled once the work was cancelled, failure once its time or checks are used up.
  void check() const {
    ++checks_;
    if (whole_ != nullptr) whole_->check();
    if (checks_ > most_checks_) throw failure(work_subject, "the share of work is used up");
    if (progress_) ask_again();
    if (limit_seconds_ > 0 && std::chrono::steady_clock::now() > deadline_) throw time_is_over();
    if (cancelled()) throw Error(Error::Kind::cancelled, "", "the work was cancelled");
  }

  /// Reports the fraction of a stage that is done, then behaves as check() of the whole context.
  void report(Stage stage, double fraction) {
    if (whole_ != nullptr) return whole_->report(stage, fraction);
    if (progress_) {
      const std::lock_guard lock(mutex_);
      stage_ = name_of(stage);
      fraction_ = std::max(fraction_, overall(stage, fraction));
      ask();
    }
    check();
  }

  /// Adds wall-clock seconds to a stage.
  void add_seconds(Stage stage, double seconds) {
    if (whole_ != nullptr) return whole_->add_seconds(stage, seconds);
    const std::lock_guard lock(mutex_);
    seconds_[std::string(name_of(stage))] += seconds;
  }
  /// Wall-clock seconds by stage so far; for stages run on several threads, the sum over the threads.
  std::map<std::string, double> seconds() const {
    const std::lock_guard lock(mutex_);
    return seconds_;
  }

 private:
  static std::int64_t now() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::milliseconds(1);
  }

  /// The fraction done of all expected stages, each weighted by the time that it usually takes.
  double overall(Stage stage, double fraction) const {
    constexpr std::array<double, stage_names.size()> shares{5, 50, 5, 5, 50, 20, 5, 15, 35, 20, 10, 10};
    double before = 0, here = 0, all = 0;
    for (const Stage expected : expected_) {
      const double share = shares[static_cast<std::size_t>(expected)];
      if (expected < stage) before += share;
      if (expected == stage) here = share;
      all += share;
    }
    return all > 0 ? (before + here * std::clamp(fraction, 0.0, 1.0)) / all : 0;
  }

  /// Needs the lock.
  void ask() const {
    asked_.store(now(), std::memory_order_relaxed);
    if (!progress_(stage_, fraction_)) cancelled_.store(true, std::memory_order_relaxed);
  }

  void ask_again() const {
    if (now() - asked_.load(std::memory_order_relaxed) < interval_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);  // the thread that holds the lock calls for all
    if (lock && !stage_.empty()) ask();
  }

  Error time_is_over() const {
    return failure(time_subject, fmt::format("the time limit of {:g} s is reached", limit_seconds_));
  }

  int threads_ = 0;
  ExecutionContext* whole_ = nullptr;
  std::int64_t most_checks_ = std::numeric_limits<std::int64_t>::max();
  mutable std::atomic<std::int64_t> checks_{0};
  Progress progress_;
  std::int64_t interval_ = 50;  // milliseconds
  double limit_seconds_ = 0;    // 0 = none
  std::chrono::steady_clock::time_point deadline_;
  mutable std::atomic<bool> cancelled_{false};
  mutable std::atomic<std::int64_t> asked_{0};  // time of the last progress call, milliseconds
  mutable std::mutex mutex_;
  std::vector<Stage> expected_{Stage::size, Stage::sample, Stage::mesh, Stage::slide, Stage::assemble};
  std::string_view stage_;  // last reported
  double fraction_ = 0;     // of all work
  std::map<std::string, double> seconds_;
};

/// Checks a context once in a number of calls, for loops whose iterations are too short for a check each. Not
/// thread-safe.
class SparseCheck {
 public:
  /// \param calls number of calls per check.
  explicit SparseCheck(const ExecutionContext& context, int calls = 1024)
      : context_(context), calls_(calls), left_(calls) {}

  void operator()() {  ///< Counts a call and checks the context when it is due.
    if (--left_ > 0) return;
    left_ = calls_;
    context_.check();
  }

 private:
  const ExecutionContext& context_;
  int calls_, left_;
};

/// Adds the time from its construction to its destruction to a stage of the context.
class StageTimer {
 public:
  /// Starts the clock.
  StageTimer(ExecutionContext& context, Stage stage)
      : context_(context), stage_(stage), start_(std::chrono::steady_clock::now()) {}
  ~StageTimer() {
    context_.add_seconds(stage_,
                         std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  ExecutionContext& context_;
  Stage stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace quadrille
