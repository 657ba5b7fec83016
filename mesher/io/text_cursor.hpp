#pragma once
/// Steps through the bytes of a mesh file.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "geometry/base/error.hpp"
#include "geometry/base/text_parts.hpp"

namespace quadrille {

/// A position in a text (or a binary file with text in it). Its errors name the file and the line.
class TextCursor {
 public:
  TextCursor(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  bool at_end() const { return position_ >= text_.size(); }
  std::size_t remaining() const { return text_.size() - position_; }
  const std::string& name() const { return name_; }

  /// The rest of the current line without its end; steps to the next line.
  std::string_view line() {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string_view result = text_.substr(position_, end - position_);
    line_begin_ = position_;
    position_ = std::min(end + 1, text_.size());
    if (!result.empty() && result.back() == '\r') result.remove_suffix(1);
    return result;
  }

  /// The next word; empty at the end.
  std::string_view word() {
    skip_space();
    const std::size_t begin = position_;
    while (!at_end() && !is_space(text_[position_])) ++position_;
    return text_.substr(begin, position_ - begin);
  }

  /// The next number, after white space. Throws Error (failure) that says what was expected.
  std::int64_t integer(const char* what) { return parse<std::int64_t>(what); }
  double real(const char* what) { return parse<double>(what); }

  /// The next sizeof(T) bytes as they lie in memory.
  template <class T>
  T binary(const char* what) {
    if (remaining() < sizeof(T)) throw truncated(what);
    T value;
    std::memcpy(&value, text_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  /// Steps past the next occurrence of `marker`; false when there is none.
  bool skip_past(std::string_view marker) {
    const std::size_t found = text_.find(marker, position_);
    if (found == std::string_view::npos) return false;
    position_ = found + marker.size();
    return true;
  }

  /// An error at the current line.
  Error error(const std::string& sentence) const { return error_at(position_, sentence); }
  /// An error at the line that line() returned last.
  Error error_before(const std::string& sentence) const { return error_at(line_begin_, sentence); }
  Error truncated(const char* what) const {
    return failure(name_, fmt::format("{}: the file ends where {} should be", name_, what));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  void skip_space() {
    while (!at_end() && is_space(text_[position_])) ++position_;
  }

  template <class T>
  T parse(const char* what) {
    skip_space();
    if (at_end()) throw truncated(what);
    const char* begin = text_.data() + position_;
    const char* end = text_.data() + text_.size();
    T value{};
    const auto result = std::from_chars(*begin == '+' ? begin + 1 : begin, end, value);
    if (result.ec != std::errc() || (result.ptr != end && !is_space(*result.ptr)))
      throw error(fmt::format("expected {}, found \"{}\"", what, shown_word()));
    position_ += static_cast<std::size_t>(result.ptr - begin);
    return value;
  }

  Error error_at(std::size_t position, const std::string& sentence) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position), '\n');
    return failure(name_, fmt::format("{}: line {}: {}", name_, line, sentence));
  }

  /// The word at the position for a message: at most 30 characters, printable ones only.
  std::string shown_word() const {
    std::string shown;
    for (std::size_t i = position_; i < text_.size() && !is_space(text_[i]) && shown.size() < 30; ++i)
      shown += text_[i] > ' ' && text_[i] < 127 ? text_[i] : '?';
    return shown;
  }

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  std::size_t line_begin_ = 0;
};

}  // namespace quadrille
