#include "calibration/projections/grid_map.h"

#include "tests/support/random_numbers.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(640, 480);

// Positions in a picture of 300 x 200 pixels that an affine map shows, at the centres of cells.
NumberMap affinePositions(glm::ivec2 nodes, glm::dmat2 matrix, glm::dvec2 shift) {
    NumberMap map{nodes, 2, false, {}};
    for (int y = 0; y < nodes.y; ++y)
        for (int x = 0; x < nodes.x; ++x) {
            const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(nodes);
            const glm::vec2 value(matrix * place + shift);
            map.values.insert(map.values.end(), {value.x, value.y});
        }
    return map;
}

TEST(GridMapBorder, GoesOnStraightWhereValuesArePositions) {
    test::Random random(11);
    const auto number = [&] { return random.uniform(-1, 1); };
    for (int round = 0; round < 50; ++round) {
        const glm::ivec2 nodes(random.uniform(2, 8), random.uniform(2, 8));
        const glm::dmat2 matrix(300 + number(), 40 * number(), 40 * number(), 200 + number());
        const glm::dvec2 shift(10 * number(), 10 * number());
        NodeMeaning meaning;
        meaning.border = BorderCells::straight;
        const GridMap map(affinePositions(nodes, matrix, shift), meaning, kSizePx, Alignment::centers);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec2 place = random.pixel({1, 1});
            const auto value = map.at(place * glm::dvec2(kSizePx));
            ASSERT_TRUE(value);
            // An affine map is straight everywhere, the half cells at the border included; numbers are
            // floats.
            EXPECT_LT(glm::distance(*value, matrix * place + shift), 2e-4);
            const auto back = map.positions(*value);
            ASSERT_EQ(back.size(), 1u);
            EXPECT_LT(glm::distance(back[0], place * glm::dvec2(kSizePx)), 1e-6);
        }
    }
}

TEST(GridMapBorder, KeepsTheOffsetWhereValuesAreOffsets) {
    NumberMap map{{2, 2}, 2, false, {0, 0, 10, 0, 0, 0, 10, 0}};
    NodeMeaning meaning;
    meaning.isOffset = true;
    const GridMap clamped(map, meaning, {100, 100}, Alignment::centers);
    EXPECT_EQ(clamped.at({0, 50}), glm::dvec2(0, 50));
    EXPECT_EQ(clamped.at({100, 50}), glm::dvec2(110, 50));
    meaning.border = BorderCells::straight;
    const GridMap straight(map, meaning, {100, 100}, Alignment::centers);
    EXPECT_EQ(straight.at({0, 50}), glm::dvec2(-5, 50));
    EXPECT_EQ(straight.at({100, 50}), glm::dvec2(115, 50));
}

}  // namespace
}  // namespace curvewall
