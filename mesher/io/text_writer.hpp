#pragma once
/// Fast text output: numbers go by std::to_chars into a large buffer, since writing must cost less than
/// meshing.

#include <charconv>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "mesher/io/atomic_file.hpp"

namespace quadrille {

/// Appends text to a file. flush() must be called at the end.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : file_(file), buffer_(capacity) {}

  TextWriter& operator<<(std::string_view text) {
    if (text.size() > room()) flush();
    if (text.size() > capacity) {
      file_.write(text);
      return *this;
    }
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

  /// Right-aligned in `width` columns.
  TextWriter& padded(int value, int width) {
    char digits[16];
    return align({digits, to_text(digits, value)}, width);
  }
  /// In Fortran's E notation with 17 significant digits, right-aligned in `width` columns.
  TextWriter& scientific(double value, int width) {
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16).ptr;
    return align({digits, static_cast<std::size_t>(end - digits)}, width);
  }

  /// The shortest text that reads back as the same double or, when that is longer than `most` characters, the
  /// closest that is not: CalculiX reads 20 and would lose the end of an exponent.
  TextWriter& within(double value, int most) {
    char digits[32];
    const char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    for (int precision = 16; end - digits > most && precision > 0; --precision)
      end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }

  void flush() {
    file_.write({buffer_.data(), size_});
    size_ = 0;
  }

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 20;

  std::size_t room() const { return capacity - size_; }
  void reserve(std::size_t bytes) {
    if (bytes > room()) flush();
  }
  template <class Number>
  static std::size_t to_text(char* begin, Number value) {
    return static_cast<std::size_t>(std::to_chars(begin, begin + 16, value).ptr - begin);
  }
  template <class Number>
  TextWriter& number(Number value) {
    reserve(32);
    char* begin = buffer_.data() + size_;
    size_ += static_cast<std::size_t>(std::to_chars(begin, begin + 32, value).ptr - begin);
    return *this;
  }
  TextWriter& align(std::string_view text, int width) {
    for (int i = static_cast<int>(text.size()); i < width; ++i) *this << ' ';
    return *this << text;
  }

  AtomicFile& file_;
  std::vector<char> buffer_;
  std::size_t size_ = 0;
};

}  // namespace quadrille
