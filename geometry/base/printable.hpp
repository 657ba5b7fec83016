#pragma once
/// Names from files and command lines, made safe for terminals and for text that is read line by line.

#include <string>
#include <string_view>

namespace quadrille {

/// The text with everything replaced that a terminal would obey or that would break the line: control
/// characters (also those beyond ASCII), marks that turn the direction of writing, bytes that are not UTF-8.
/// \param stand_in put in their place; empty = they are shown as \x1b or \u202e. \param kept one control
/// character that stays, such as a line break; 0 = none.
std::string printable(std::string_view text, std::string_view stand_in = {}, char kept = 0);

}  // namespace quadrille
