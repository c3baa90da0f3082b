#include "cli/progress_bar.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

TEST(ProgressLine, FillsUp) {
    EXPECT_EQ(progressLine(0, 4, 40'000, "a", 8), "[........] 0/4, 40 s left: a");
    EXPECT_EQ(progressLine(1, 4, 40'000, "b", 8), "[##......] 1/4, 40 s left: b");
    EXPECT_EQ(progressLine(4, 4, 0, "c", 8), "[########] 4/4, 0 s left: c");
}

TEST(ProgressLine, SaysHowLongInUnitsThatFit) {
    EXPECT_EQ(progressLine(0, 1, 200'000, "a", 1), "[.] 0/1, 3 min left: a");
    EXPECT_EQ(progressLine(0, 1, 9'000'000, "a", 1), "[.] 0/1, 2 h 30 min left: a");
}

TEST(ProgressLine, OfNothingIsEmpty) { EXPECT_EQ(progressLine(0, 0, 0, "a", 2), "[..] 0/0, 0 s left: a"); }

}  // namespace
}  // namespace curvewall
