#include "renderer/sample_pattern.h"

#include <gtest/gtest.h>

#include <set>

namespace curvewall {
namespace {

TEST(SamplePattern, OneSampleIsThePixelCentre) {
    EXPECT_EQ(samplePattern(1, 7), std::vector<glm::dvec2>{glm::dvec2(0.5)});
}

TEST(SamplePattern, SquareNumbersPutOneSampleIntoEachCell) {
    for (const int side : {2, 3, 4, 8})
        for (uint64_t seed = 0; seed < 100; ++seed) {
            std::set<int> cells;
            for (const glm::dvec2 p : samplePattern(side * side, seed)) {
                const glm::ivec2 cell(glm::floor(p * static_cast<double>(side)));
                EXPECT_TRUE(cell.x >= 0 && cell.x < side && cell.y >= 0 && cell.y < side);
                cells.insert(cell.y * side + cell.x);
            }
            EXPECT_EQ(cells.size(), static_cast<size_t>(side * side));
        }
}

// Half of an even spread lies in each half of the pixel, up to the discrepancy of the sequence; of 32
// independent samples, 8 more or fewer would be usual among so many seeds.
TEST(SamplePattern, AnyNumberIsSpreadEvenly) {
    for (const int samples : {2, 3, 8, 32, 100})
        for (uint64_t seed = 0; seed < 100; ++seed) {
            const auto pattern = samplePattern(samples, seed);
            ASSERT_EQ(pattern.size(), static_cast<size_t>(samples));
            int left = 0, upper = 0;
            for (const glm::dvec2 p : pattern) {
                EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                left += p.x < 0.5;
                upper += p.y < 0.5;
            }
            EXPECT_NEAR(left, samples / 2.0, 3.5) << samples;
            EXPECT_NEAR(upper, samples / 2.0, 3.5) << samples;
        }
}

TEST(SamplePattern, TheSeedAloneDecides) {
    for (const int samples : {4, 5}) {
        EXPECT_EQ(samplePattern(samples, 42), samplePattern(samples, 42));
        EXPECT_NE(samplePattern(samples, 42), samplePattern(samples, 43));
    }
}

// Over many pixels every place in a pixel is as likely as any other; sigma of the mean is 0.29 /
// sqrt(40,000).
TEST(SamplePattern, NeighbouringPixelsAreIndependent) {
    glm::dvec2 sum(0);
    double product = 0;
    for (uint64_t seed = 0; seed < 40000; ++seed) {
        const glm::dvec2 here = samplePattern(2, seed)[0], next = samplePattern(2, seed + 1)[0];
        sum += here;
        product += (here.x - 0.5) * (next.x - 0.5);
    }
    EXPECT_NEAR(sum.x / 40000, 0.5, 0.006);
    EXPECT_NEAR(sum.y / 40000, 0.5, 0.006);
    EXPECT_NEAR(product / 40000, 0, 0.002);
}

}  // namespace
}  // namespace curvewall
