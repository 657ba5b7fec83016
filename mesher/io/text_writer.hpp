#pragma once
/// Fast text output: std::to_chars formats numbers into a large buffer, since writing must take less time
/// than meshing.

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

/// Appends text to a file, or keeps it in memory if there is no file. For a file, call flush() at the end.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : file_(&file), buffer_(capacity) {}
  TextWriter() = default;

  TextWriter& operator<<(std::string_view text) {
    if (file_ != nullptr && text.size() > capacity / 4) {
      flush();
      file_->write(text);
      return *this;
    }
    reserve(text.size());
    std::memcpy(buffer_.data() + size_, text.data(), text.size());
    size_ += text.size();
    return *this;
  }
  TextWriter& operator<<(const char* text) { return *this << std::string_view(text); }
  TextWriter& operator<<(char character) {
    reserve(1);
    buffer_[size_++] = character;
    return *this;
  }
  TextWriter& operator<<(int value) { return number(value); }
  TextWriter& operator<<(std::size_t value) { return number(value); }
  /// The shortest text that reads back as the same double.
  TextWriter& operator<<(double value) { return number(value); }

  /// "x y z"
  TextWriter& operator<<(const Vector3& point) {
    return *this << point.x() << ' ' << point.y() << ' ' << point.z();
  }

  /// Right-aligned in `width` columns.
  TextWriter& padded(std::string_view text, int width) {
    for (int i = static_cast<int>(text.size()); i < width; ++i) *this << ' ';
    return *this << text;
  }
  TextWriter& padded(int value, int width) {
    char digits[16];
    return padded({digits, std::to_chars(digits, digits + sizeof digits, value).ptr}, width);
  }
  /// In Fortran's E notation with 17 significant digits, right-aligned in `width` columns.
  TextWriter& scientific(double value, int width) {
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16).ptr;
    return padded({digits, end}, width);
  }

  /// The shortest text that reads back as the same double. If that is longer than `most` characters, the
  /// closest text that fits: CalculiX reads 20 characters and would lose the end of an exponent.
  TextWriter& within(double value, int most) {
    char digits[32];
    char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    for (int precision = 16; end - digits > most && precision > 0; --precision)
      end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision).ptr;
    return *this << std::string_view(digits, end);
  }

  void flush() {
    file_->write({buffer_.data(), size_});
    size_ = 0;
  }

  /// The text kept in memory if there is no file.
  std::string_view text() const { return {buffer_.data(), size_}; }
  /// Drops the text but keeps its memory.
  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 20;

  void reserve(std::size_t bytes) {
    if (bytes <= buffer_.size() - size_) return;
    if (file_ != nullptr)
      flush();
    else
      buffer_.resize(2 * buffer_.size() + bytes + capacity / 2);
  }
  template <class Number>
  TextWriter& number(Number value) {
    reserve(32);
    char* begin = buffer_.data() + size_;
    size_ += static_cast<std::size_t>(std::to_chars(begin, begin + 32, value).ptr - begin);
    return *this;
  }

  AtomicFile* file_ = nullptr;
  std::vector<char> buffer_;
  std::size_t size_ = 0;
};

/// Writes items 0 .. count - 1 in order, as if by write(item, out) for each. All threads of the arena format
/// blocks of some thousand items at a time.
template <class Write>
void write_in_order(std::size_t count, TextWriter& out, Write&& write) {
  constexpr std::size_t at_once = 8192;
  const auto write_range = [&](std::size_t begin, TextWriter& to) {
    for (std::size_t i = begin; i < std::min(begin + at_once, count); ++i) write(static_cast<int>(i), to);
  };
  namespace tbb = oneapi::tbb;
  const int threads = tbb::this_task_arena::max_concurrency();
  std::size_t next = 0;
  if (threads == 1 || count <= at_once) {
    for (; next < count; next += at_once) write_range(next, out);
    return;
  }
  const auto take = [&](tbb::flow_control& control) {
    if (next >= count) control.stop();
    return std::exchange(next, next + at_once);
  };
  // The pipeline passes pointers, since it does not destroy what it holds when a filter throws. Texts are
  // written in order, so those in progress are consecutive, and an entry of `texts` is free when reused.
  const int under_way = 2 * threads;
  std::vector<TextWriter> texts(under_way);
  const auto make_text = [&](std::size_t begin) {
    TextWriter& text = texts[begin / at_once % texts.size()];
    text.clear();
    write_range(begin, text);
    return &text;
  };
  tbb::parallel_pipeline(
      under_way, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, take) &
                     tbb::make_filter<std::size_t, TextWriter*>(tbb::filter_mode::parallel, make_text) &
                     tbb::make_filter<TextWriter*, void>(tbb::filter_mode::serial_in_order,
                                                         [&](TextWriter* text) { out << text->text(); }));
}

}  // namespace quadrille
