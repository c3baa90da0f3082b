#include "calibration/pieces/facet_patch.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace curvewall {
namespace {

// A flat screen in 5 x 5 cells of two triangles each. Vertex (i, j) has the number 6 j + i.
class FacetPatchTest : public ::testing::Test {
protected:
    FacetPatchTest() {
        PieceGrid grid{{50, 50}, 5, 5, {}};
        for (int j = 0; j <= 5; ++j)
            for (int i = 0; i <= 5; ++i) {
                grid.vertices.push_back({pointAt({10 * i, 10 * j}), {10 * i, 10 * j}});
                motion_.addVertex(std::array<Motion::Term, 1>{{{static_cast<uint32_t>(6 * j + i), 1}}});
            }
        mesh_ = meshFromGrid(grid, false);
    }

    static glm::dvec3 pointAt(glm::dvec2 px) { return {(px.x - 25) / 25, (25 - px.y) / 25, -1}; }

    double errorPx() const {
        double largest = 0;
        for (uint32_t k = 0; k < mesh_.pieces.size(); ++k)
            for (const FacetSample& sample : samplesOf(k)) {
                const glm::dvec3 h = mesh_.pieces[k].screenFromRay * sample.ray;
                largest = std::max(largest, glm::distance(glm::dvec2(h) / h.z, sample.px));
            }
        return largest;
    }

    std::vector<FacetSample> samplesOf(uint32_t piece) const {
        std::vector<FacetSample> samples;
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; i + j <= 4; ++j) {
                FacetSample sample{piece, {i / 4.0, j / 4.0, (4 - i - j) / 4.0}, {}, {}};
                for (size_t c = 0; c < 3; ++c)
                    sample.px += sample.blend[c] * mesh_.vertices[mesh_.pieces[piece].vertices[c]].s;
                sample.ray = pointAt(sample.px);
                samples.push_back(sample);
            }
        return samples;
    }

    PieceMesh mesh_;
    Motion motion_;
};

TEST_F(FacetPatchTest, RepairsWhatIsOffAndLeavesTheRestInPlace) {
    const auto off = static_cast<size_t>(6 * 2 + 2);
    mesh_.vertices[off].m += glm::dvec3(0.1, -0.05, 0.02);
    updateHomographies(mesh_);
    ASSERT_GT(errorPx(), 1);
    const PieceMesh before = mesh_;
    const uint32_t centre = 24;  // the first triangle of the cell that has this corner
    ASSERT_TRUE(std::ranges::count(mesh_.pieces[centre].vertices, off));

    FacetPatch patch(mesh_, motion_, {centre}, 0);
    std::vector<FacetSample> samples;
    for (uint32_t own = 0; own < patch.pieces().size(); ++own)
        for (FacetSample sample : samplesOf(patch.pieces()[own])) {
            sample.piece = own;
            samples.push_back(sample);
        }
    patch.balance(samples, 1e-7, {});
    patch.putBack(mesh_);

    EXPECT_LT(errorPx(), 1e-3);
    for (uint32_t v = 0; v < mesh_.vertices.size(); ++v)
        if (!std::ranges::count(mesh_.pieces[centre].vertices, v)) {
            EXPECT_EQ(mesh_.vertices[v].m, before.vertices[v].m) << v;
        }
}

TEST_F(FacetPatchTest, GrowsByRings) {
    const FacetPatch near(mesh_, motion_, {24}, 0), wide(mesh_, motion_, {24}, 1);
    EXPECT_GT(near.pieces().size(), 1u);
    EXPECT_GT(wide.pieces().size(), near.pieces().size());
    EXPECT_TRUE(std::ranges::includes(wide.pieces(), near.pieces()));
    EXPECT_LT(near.pieces().size(), mesh_.pieces.size());
}

}  // namespace
}  // namespace curvewall
