#pragma once
/// The one exception type of the library.

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/base/api.hpp"

namespace quadrille {

/// An error: one sentence for the user (`what()`) and the thing that it concerns.
class QUADRILLE_API Error : public std::runtime_error {
 public:
  /// The cause of an error.
  enum class Kind {
    usage,     ///< the caller asked for something that makes no sense (the command exits with 2)
    failure,   ///< the input or the machine made it impossible (the command exits with 1)
    cancelled  ///< the caller cancelled the work
  };

  /// \param subject the file, face ("Face3"), element or setting ("size_min") concerned; may be empty.
  Error(Kind kind, std::string subject, const std::string& sentence)
      : std::runtime_error(sentence), kind_(kind), subject_(std::move(subject)) {}

  Kind kind() const noexcept { return kind_; }                      ///< cause of the error
  const std::string& subject() const noexcept { return subject_; }  ///< what it concerns

 private:
  Kind kind_;
  std::string subject_;
};

/// What an exception says, in words for users where the standard library has only the name of a function.
inline std::string sentence_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
      dynamic_cast<const std::length_error*>(&error) != nullptr)
    return "there is not enough memory for it (a damaged file may promise more than it holds)";
  return error.what();
}

/// An Error of kind `usage`.
inline Error usage_error(std::string subject, const std::string& sentence) {
  return {Error::Kind::usage, std::move(subject), sentence};
}
/// An Error of kind `failure`.
inline Error failure(std::string subject, const std::string& sentence) {
  return {Error::Kind::failure, std::move(subject), sentence};
}

}  // namespace quadrille
