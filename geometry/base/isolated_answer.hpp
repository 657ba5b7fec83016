#pragma once
/// What a child process writes back, the same on all systems: its result or its error, and a mark at the end.
/// Internal.

#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "geometry/base/isolated_work.hpp"

namespace quadrille {

/// Does the work and writes what it makes, or the sentence of what it throws, and the end mark, which a child
/// that crashes does not get to. Throws nothing. \param subject of sentences without one.
void write_answer(const std::string& subject, const std::function<void(std::ostream&)>& work,
                  std::ostream& out);

/// What a child that has no memory left writes last, without taking any, whatever it has written before.
inline constexpr std::string_view answer_without_memory = "\nquadrille has answered: M";

/// What the child has made, from all that it wrote. Throws the Error that the child has thrown; Error
/// (failure) if the end mark is missing.
std::string result_of(const IsolatedWork& options, std::string bytes);

/// Runs the work in a child process and returns what it made; the implementation depends on the system.
/// Throws as run_isolated().
std::string run_in_child(const IsolatedWork& options, const std::function<void(std::ostream&)>& work);

}  // namespace quadrille
