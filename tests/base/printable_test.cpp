/// Names that a terminal would obey are shown, not sent.

#include "geometry/base/printable.hpp"

#include <gtest/gtest.h>

#include <string>

namespace quadrille {
namespace {

TEST(Printable, LeavesOrdinaryNamesAlone) {
  for (const std::string name : {"", "Bracket 2.step", "Käfig_№5", "部品", "😀"})
    EXPECT_EQ(printable(name), name);
}

TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable("a\nb"), "a\\x0ab");
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb");  // turns the direction of writing
  EXPECT_EQ(printable("a\xc2\x9b"
                      "b"),
            "a\\u009bb");  // a control character beyond ASCII
}

TEST(Printable, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");           // too long for its character
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a pair of UTF-16
  EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80");           // ends too early
}

TEST(Printable, PutsAStandInAndKeepsWhatItIsTold) {
  EXPECT_EQ(printable("a\tb\nc\xff", "?", '\n'), "a?b\nc?");
}

}  // namespace
}  // namespace quadrille
