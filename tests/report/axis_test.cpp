#include "report/axis.h"

#include "tests/support/random_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

using ::testing::ElementsAre;

TEST(LogarithmicAxis, SpanningDecadesHasPowersOfTen) {
    EXPECT_THAT(logarithmicAxis({0.001, 100000}).numbers,
                ElementsAre(0.001, 0.01, 0.1, 1, 10, 100, 1000, 10000, 100000));
}

TEST(LogarithmicAxis, OfOneDecadeHasNumbersBetween) {
    EXPECT_THAT(logarithmicAxis({20, 300}).numbers, ElementsAre(20, 30, 50, 70, 100, 200, 300));
}

TEST(LogarithmicAxis, OfNearlyEqualValuesHasEvenNumbers) {
    EXPECT_THAT(logarithmicAxis({64, 68}).numbers, ElementsAre(62, 64, 66, 68, 70));
}

TEST(LinearAxis, HasEvenNumbers) {
    EXPECT_THAT(linearAxis({31, 52}).numbers, ElementsAre(30, 35, 40, 45, 50));
}

TEST(Axes, HoldTheirValuesAndSomeNumbers) {
    test::Random random(3);
    for (int round = 0; round < 1000; ++round) {
        std::vector<double> values(1 + static_cast<size_t>(random.uniform(0, 5)));
        for (double& value : values) value = std::exp(random.uniform(-20, 20));
        for (const Axis& axis : {logarithmicAxis(values), linearAxis(values)}) {
            const auto [least, most] = std::ranges::minmax(values);
            EXPECT_LT(axis.least, least);
            EXPECT_GT(axis.most, most);
            EXPECT_GE(axis.numbers.size(), 3u);
            EXPECT_LE(axis.numbers.size(), 20u);
            for (const double number : axis.numbers) {
                EXPECT_GE(number, axis.least);
                EXPECT_LE(number, axis.most);
            }
        }
    }
}

TEST(Axes, OfNothingAreThere) {
    EXPECT_LT(logarithmicAxis({}).least, logarithmicAxis({}).most);
    EXPECT_LT(linearAxis({}).least, linearAxis({}).most);
    EXPECT_LT(linearAxis({0}).least, 0);
}

}  // namespace
}  // namespace curvewall
