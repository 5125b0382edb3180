#include <gtest/gtest.h>

#include "core/format.hpp"

namespace chainreel {
namespace {

TEST(Printable, KeepsTextAndShowsOrders) {
  const std::string plain = "Roboter, \xce\xb1 \xe2\x80\x94 \xf0\x9f\xa4\x96\n\tx";
  EXPECT_EQ(printable(plain), plain);
  EXPECT_EQ(printable("a\x1b[31mb\rc\x7f"), "a\\u001b[31mb\\u000dc\\u007f");
  EXPECT_EQ(printable("\xc2\x9b" "1m"), "\\u009b1m");              // a control character of two bytes
  EXPECT_EQ(printable("\xe2\x80\xae" "x"), "\\u202ex");             // turns the direction of writing
  EXPECT_EQ(printable("\x9b\xff"), "\\u009b\\u00ff");               // no UTF-8
  EXPECT_EQ(printable("\xc0\xaf"), "\\u00c0\\u00af");               // longer than it needs to be
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\u00ed\\u00a0\\u0080");    // half of a pair
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\u0000");
  EXPECT_EQ(printable("\xe2\x80"), "\\u00e2\\u0080");               // cut off
}

TEST(Printable, DoesNotMindWhereATextIsCut) {
  const std::string text = "\xce\xb1\x1b\xf0\x9f\xa4\x96\xe2\x80\xae\xffz";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    PrintableStream stream;
    std::string result = stream.next(text.substr(0, cut));
    result += stream.next(text.substr(cut));
    EXPECT_EQ(result + stream.end(), printable(text)) << cut;
  }
}

TEST(Shortened, KeepsWholeCharactersAndTellsTheRest) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc.. (1 bytes more)");
  EXPECT_EQ(shortened("a\xce\xb1z", 2), "a.. (3 bytes more)");
}

}  // namespace
}  // namespace chainreel
