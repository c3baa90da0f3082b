#pragma once
// Which piece owns a pixel: decided once a mesh, exactly, in integers.

#include "calibration/pieces/piece_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace curvewall {

inline constexpr int32_t kNoPiece = -1;

// A pixel belongs to the piece that has its centre, or another sample of it. Vertices are rounded to the grid
// of 1/256 px, and where an edge crosses a row of centres follows from its two ends alone, in integers:
// pieces that share an edge agree on every centre, also where rounding made them a little concave. A centre
// on an edge goes by the top-left rule. Where pieces overlap (a fold), the later one owns.
class Ownership {
public:
    // `sampleInPixel` counts from the pixel's top left corner and is rounded to the grid.
    explicit Ownership(const PieceMesh& mesh, glm::dvec2 sampleInPixel = glm::dvec2(0.5));

    // The owners, or kNoPiece, of the pixels in every `every`-th row and column: of rows `fromRow` up to but
    // not including `endRow` of that lattice, one after another.
    void fillRows(int fromRow, int endRow, int every, std::span<int32_t> owners) const;

private:
    struct Polygon {
        std::array<glm::i64vec2, kMostPieceEdges> corners{};  // units of 1/256 px
        size_t count = 0;
        int firstRow = 0, endRow = 0;  // rows whose centres it reaches
    };

    int width_;
    std::vector<Polygon> polygons_;  // of the pieces, in order
};

// The owners of all pixels, row by row from the top.
std::vector<int32_t> ownerImage(const PieceMesh& mesh, glm::dvec2 sampleInPixel = glm::dvec2(0.5));

}  // namespace curvewall
