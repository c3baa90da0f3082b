#include "calibration/projections/polynomial.h"

#include "tests/support/random_numbers.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace curvewall {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Polynomial, ArithmeticIsThatOfItsValues) {
    const Polynomial a{1, -2, 0, 3}, b{0.5, 4};
    for (const double t : {-2.0, 0.0, 0.3, 5.0}) {
        EXPECT_DOUBLE_EQ(valueOf(a + b, t), valueOf(a, t) + valueOf(b, t));
        EXPECT_DOUBLE_EQ(valueOf(a - b, t), valueOf(a, t) - valueOf(b, t));
        EXPECT_DOUBLE_EQ(valueOf(a * b, t), valueOf(a, t) * valueOf(b, t));
        EXPECT_DOUBLE_EQ(valueOf(derivativeOf(a), t), -2 + 9 * t * t);
    }
}

TEST(Polynomial, FindsEveryRootOfTheProductOfItsFactors) {
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        std::vector<double> roots;
        Polynomial p{random.uniform(-3, 3)};
        for (int k = 0; k < 6; ++k) {
            const double root = random.uniform(-1, 5);
            const bool isApart =
                std::ranges::none_of(roots, [&](double other) { return std::abs(other - root) < 0.05; });
            if (!isApart) continue;
            p = p * Polynomial{-root, 1};
            roots.push_back(root);
        }
        p = p * Polynomial{2, 0.5, 1};  // no real root
        std::erase_if(roots, [](double root) { return root <= 0; });
        std::ranges::sort(roots);
        const std::vector<double> found = rootsWithin(p, 0, 5);
        ASSERT_EQ(found.size(), roots.size()) << i;
        for (size_t k = 0; k < roots.size(); ++k) ASSERT_NEAR(found[k], roots[k], 1e-7);
    }
}

TEST(Polynomial, EndsOfTheIntervalAreOpenBelowAndClosedAbove) {
    EXPECT_THAT(rootsWithin({0, 1}, 0, 1), IsEmpty());
    EXPECT_THAT(rootsWithin({-1, 1}, 0, 1), ElementsAre(DoubleNear(1, 1e-15)));
    EXPECT_THAT(rootsWithin({0, -1, 0, 1}, 0, 2), ElementsAre(DoubleNear(1, 1e-15)));
    EXPECT_THAT(rootsWithin({3}, 0, 1), IsEmpty());
    EXPECT_THAT(rootsWithin({0, 0, 0}, 0, 1), IsEmpty());
    EXPECT_THAT(rootsWithin({}, 0, 1), IsEmpty());
}

}  // namespace
}  // namespace curvewall
