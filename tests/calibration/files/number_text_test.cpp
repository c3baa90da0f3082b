#include "calibration/files/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

TEST(NumberText, FiniteNumbersAreNothingElse) {
    for (const char* text : {"", "nan", "inf", "-inf", "1e999", "1 2", "1deg", "+-1", "++1", "0x10", "1,5"})
        EXPECT_FALSE(finiteNumberFrom(text)) << text;
    EXPECT_EQ(finiteNumberFrom(" \t-1.25\r\n"), -1.25);
}

TEST(NumberText, HasTheWholeTextOrNothing) {
    EXPECT_EQ(numberFrom<int>("12"), 12);
    EXPECT_EQ(numberFrom<int>("+12"), 12);
    for (const char* text : {"", "+", "+-1", "1 ", " 1", "1.5", "99999999999"})
        EXPECT_FALSE(numberFrom<int>(text)) << text;
    EXPECT_TRUE(std::isnan(numberFrom<double>("nan").value()));
    EXPECT_FALSE(numberFrom<double>("1e999"));
}

TEST(NumberText, TrimmedKeepsBlanksInside) {
    EXPECT_EQ(trimmed("\t a b\r\n"), "a b");
    EXPECT_EQ(trimmed(" \v\f"), "");
}

}  // namespace
}  // namespace curvewall
