#include "calibration/pieces/piece_drawing.h"

#include "calibration/pieces/piece_fit.h"
#include "tests/support/test_walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace curvewall {
namespace {

const Wall kWall = test::fullCylinderWall({160, 120});
const PieceMesh kMesh = fitPieces(*kWall.displays[0].projection, {160, 120}, 0.5).mesh;

TEST(PieceDrawing, JsonHoldsAllThatAnotherProgramNeedsToLandARay) {
    const nlohmann::json drawn = piecesAsJson(kMesh);
    ASSERT_EQ(drawn["pieces"].size(), kMesh.pieces.size());
    const auto vertex = [&](size_t i) {
        const nlohmann::json& v = drawn["vertices"][drawn["pieces"][0][i].get<size_t>()];
        return PieceVertex{{v["m"][0], v["m"][1], v["m"][2]}, {v["s"][0], v["s"][1]}};
    };
    EXPECT_EQ(homographyThrough(vertex(0), vertex(1), vertex(2)), kMesh.pieces[0].screenFromRay);
}

TEST(PieceDrawing, SvgHasOnePolygonAPiece) {
    const std::string svg = piecesAsSvg(kMesh);
    size_t polygons = 0;
    for (size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1))
        ++polygons;
    EXPECT_EQ(polygons, kMesh.pieces.size());
    EXPECT_THAT(svg, ::testing::HasSubstr("viewBox=\"0 0 160 120\""));
}

}  // namespace
}  // namespace curvewall
