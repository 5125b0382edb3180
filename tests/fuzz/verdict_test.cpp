#include "fuzz/verdict.hpp"

#include <gtest/gtest.h>

namespace chainreel {
namespace {

TEST(Verdict, FindsEveryKindOfFaultAndNoOther) {
  EXPECT_EQ(fault_of({.status = 0, .out = "fine\n"}, {"a.png"}), "");
  EXPECT_EQ(fault_of({.status = 3, .err = "a.yaml:1: wrong\n"}, {"a.partial.csv"}), "");
  EXPECT_NE(fault_of({.status = 139}, {}), "");
  EXPECT_NE(fault_of({.status = 8, .err = "what\n"}, {}), "");
  EXPECT_NE(fault_of({.status = 0, .timed_out = true}, {}), "");
  EXPECT_NE(fault_of({.status = 3}, {}), "");
  EXPECT_NE(fault_of({.status = 6, .err = "chainreel: std::exception\n"}, {}), "");
  EXPECT_NE(fault_of({.status = 3, .err = std::string(100, '\n')}, {}), "");
  EXPECT_NE(fault_of({.status = 3, .err = std::string(100000, 'x')}, {}), "");
  EXPECT_NE(fault_of({.status = 3, .err = "a\x1b[31m\n"}, {}), "");
  EXPECT_NE(fault_of({.status = 0, .out = "a\x1b[31m\n"}, {}), "");
  EXPECT_NE(fault_of({.status = 0}, {"out/.chainreel-x.tmp.png"}), "");
  EXPECT_NE(fault_of({.status = 3, .err = "wrong\n"}, {"half.mp4"}), "");
}

}  // namespace
}  // namespace chainreel
