#include "calibration/pieces/cell_tree.h"

#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace curvewall {
namespace {

// How many cells have each pixel.
std::vector<int> coverOf(const CellTree& tree) {
    const glm::ivec2 size = tree.sizePx();
    std::vector<int> cover(static_cast<size_t>(size.x * size.y));
    for (uint32_t id : tree.wholeCells()) {
        const Cell& cell = tree.cell(id);
        for (int y = cell.fromPx.y; y < cell.toPx.y; ++y)
            for (int x = cell.fromPx.x; x < cell.toPx.x; ++x) ++cover.at(static_cast<size_t>(y * size.x + x));
    }
    return cover;
}

TEST(CellTree, CellsTileTheDisplayHoweverTheyAreCut) {
    test::Random random(1);
    for (const glm::ivec2 size : {glm::ivec2(64, 48), {1, 50}, {37, 1}, {1, 1}, {3, 3}, {101, 67}}) {
        CellTree tree(size, {3, 7});
        for (int i = 0; i < 200; ++i) {
            const std::vector<uint32_t> whole = tree.wholeCells();
            const uint32_t id = whole[static_cast<size_t>(random.uniform(0, double(whole.size())))];
            const int axis = random.uniform(0, 1) < 0.5;
            if (tree.cell(id).sizePx()[axis] >= 2) tree.cut(id, axis);
        }
        EXPECT_TRUE(std::ranges::all_of(coverOf(tree), [](int count) { return count == 1; }));
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const uint32_t id = tree.cellAt({x, y});
                const Cell& cell = tree.cell(id);
                ASSERT_TRUE(tree.isWhole(id));
                ASSERT_TRUE(cell.fromPx.x <= x && x < cell.toPx.x && cell.fromPx.y <= y && y < cell.toPx.y);
            }
        }
    }
}

TEST(CellTree, FirstCellsAreNearlyEqualAndAtMostOneAPixel) {
    const CellTree tree({100, 3}, {7, 5});
    EXPECT_EQ(tree.wholeCells().size(), 7u * 3u);
    for (uint32_t id : tree.wholeCells()) {
        EXPECT_NEAR(tree.cell(id).sizePx().x, 100.0 / 7, 1);
        EXPECT_EQ(tree.cell(id).sizePx().y, 1);
    }
}

TEST(CellTree, ACutLeavesTheNumbersOfAllOtherCells) {
    CellTree tree({16, 16}, {2, 1});
    const Cell other = tree.cell(1);
    tree.cut(0, 1);
    EXPECT_FALSE(tree.isWhole(0));
    EXPECT_TRUE(tree.isWhole(1));
    EXPECT_EQ(tree.cell(1).fromPx, other.fromPx);
    EXPECT_EQ(tree.cell(2).toPx, glm::ivec2(8, 8));
    EXPECT_EQ(tree.cell(3).fromPx, glm::ivec2(0, 8));
}

}  // namespace
}  // namespace curvewall
