#include "calibration/blending/distance_map.h"

#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

TEST(DistanceMap, IsTheDistanceToTheNearestOfAllMarkedPixels) {
    test::Random random(1);
    for (int round = 0; round < 60; ++round) {
        const glm::ivec2 size(random.uniform(1, 30), random.uniform(1, 30));
        std::vector<uint8_t> marked(static_cast<size_t>(size.x * size.y));
        // From nearly none to nearly all.
        const double share = std::pow(random.uniform(0, 1), 3);
        for (auto& pixel : marked) pixel = random.uniform(0, 1) < share;
        const std::vector<float> distances = distancesToMarked(marked, size);
        for (int i = 0; i < size.x * size.y; ++i) {
            double nearest = std::numeric_limits<double>::infinity();
            for (int k = 0; k < size.x * size.y; ++k)
                if (marked[static_cast<size_t>(k)])
                    nearest = std::min(nearest, std::hypot(i % size.x - k % size.x, i / size.x - k / size.x));
            ASSERT_EQ(distances[static_cast<size_t>(i)], static_cast<float>(nearest)) << "round " << round;
        }
    }
}

}  // namespace
}  // namespace curvewall
