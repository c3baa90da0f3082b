#include "report/step_clock.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

TEST(StepClock, GuessesUntilAStepIsOver) {
    StepClock clock(100);
    EXPECT_EQ(clock.leftMs(), 0);
    clock.expect(3);
    EXPECT_EQ(clock.leftMs(), 300);
    clock.took(40);
    EXPECT_EQ(clock.leftMs(), 80);
}

TEST(StepClock, TakesStepsToLastAsTheyDidOnAverage) {
    StepClock clock(1);
    clock.expect(5);
    clock.took(10);
    clock.took(30);
    EXPECT_EQ(clock.leftMs(), 3 * 20);
}

TEST(StepClock, LearnsNothingFromStepsWithNothingToDo) {
    StepClock clock(100);
    clock.expect(4);
    clock.skipped();
    EXPECT_EQ(clock.leftMs(), 300);
    clock.took(50);
    clock.skipped();
    EXPECT_EQ(clock.leftMs(), 50);
    clock.took(70);
    EXPECT_EQ(clock.leftMs(), 0);
}

}  // namespace
}  // namespace curvewall
