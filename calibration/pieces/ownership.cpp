#include "calibration/pieces/ownership.h"

#include "calibration/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

using GridPoint = glm::i64vec2;  // units of 1/256 px

constexpr int64_t kUnitsPerPx = 256;
constexpr int64_t kCentre = kUnitsPerPx / 2;

GridPoint gridPoint(glm::dvec2 px) { return {std::llround(px.x / kSnapPx), std::llround(px.y / kSnapPx)}; }

int64_t ceilOfQuotient(int64_t a, int64_t b) { return a / b + (a % b > 0 ? 1 : 0); }

// The first row or column of pixels whose centre is not before a place, within a display.
int firstCentreFrom(int64_t place, int64_t unitsPerPx, int count) {
    return static_cast<int>(std::clamp<int64_t>(ceilOfQuotient(place, unitsPerPx), 0, count));
}

// The first pixel of a row whose centre is not left of where an edge crosses the line through its centres.
// The edge goes down, from above or on that line to below it. Displays are at most 16384 px wide, so products
// stay below 2^47.
int crossingColumn(GridPoint upper, GridPoint lower, int64_t lineY, int width) {
    const int64_t dy = lower.y - upper.y, dx = lower.x - upper.x;
    return firstCentreFrom((upper.x - kCentre) * dy + (lineY - upper.y) * dx, kUnitsPerPx * dy, width);
}

// Where a row of centres enters and leaves a polygon, in turn.
class Crossings {
public:
    void add(int column) {
        size_t at = count_++;
        for (; at > 0 && columns_[at - 1] > column; --at) columns_[at] = columns_[at - 1];
        columns_[at] = column;
    }
    std::span<const int> ascending() const { return std::span(columns_).first(count_); }

private:
    std::array<int, kMostPieceEdges> columns_{};
    size_t count_ = 0;
};

}  // namespace

Ownership::Ownership(const PieceMesh& mesh, glm::dvec2 sampleInPixel) : width_(mesh.sizePx.x) {
    const GridPoint shift = gridPoint(glm::dvec2(0.5) - sampleInPixel);  // brings the sample to the centre
    polygons_.reserve(mesh.pieces.size());
    for (const Piece& piece : mesh.pieces) {
        Polygon& polygon = polygons_.emplace_back();
        int64_t top = std::numeric_limits<int64_t>::max(), bottom = std::numeric_limits<int64_t>::min();
        for (; polygon.count < piece.vertexCount; ++polygon.count) {
            const GridPoint corner = gridPoint(mesh.vertices[piece.vertices[polygon.count]].s) + shift;
            polygon.corners[polygon.count] = corner;
            top = std::min(top, corner.y);
            bottom = std::max(bottom, corner.y);
        }
        polygon.firstRow = firstCentreFrom(top - kCentre, kUnitsPerPx, mesh.sizePx.y);
        polygon.endRow = firstCentreFrom(bottom - kCentre, kUnitsPerPx, mesh.sizePx.y);
    }
}

void Ownership::fillRows(int fromRow, int endRow, int every, std::span<int32_t> owners) const {
    // The lattice's first row or column at or after a pixel's.
    const auto onLattice = [every](int px) { return (px + every - 1) / every; };
    const auto latticeWidth = static_cast<size_t>(onLattice(width_));
    std::ranges::fill(owners, kNoPiece);
    for (size_t k = 0; k < polygons_.size(); ++k) {
        const Polygon& polygon = polygons_[k];
        const int first = std::max(fromRow, onLattice(polygon.firstRow));
        const int end = std::min(endRow, onLattice(polygon.endRow));
        for (int row = first; row < end; ++row) {
            const int64_t lineY = int64_t{row} * every * kUnitsPerPx + kCentre;
            Crossings crossings;
            for (size_t i = 0; i < polygon.count; ++i) {
                GridPoint upper = polygon.corners[i], lower = polygon.corners[(i + 1) % polygon.count];
                if (upper.y > lower.y) std::swap(upper, lower);
                if (upper.y <= lineY && lineY < lower.y)
                    crossings.add(onLattice(crossingColumn(upper, lower, lineY, width_)));
            }
            int32_t* const pixels = owners.data() + static_cast<size_t>(row - fromRow) * latticeWidth;
            const std::span<const int> columns = crossings.ascending();
            for (size_t i = 0; i + 1 < columns.size(); i += 2)
                std::fill(pixels + columns[i], pixels + columns[i + 1], static_cast<int32_t>(k));
        }
    }
}

std::vector<int32_t> ownerImage(const PieceMesh& mesh, glm::dvec2 sampleInPixel) {
    const Ownership ownership(mesh, sampleInPixel);
    const auto width = static_cast<size_t>(mesh.sizePx.x);
    std::vector<int32_t> owners(width * static_cast<size_t>(mesh.sizePx.y));
    parallelRanges(mesh.sizePx.y, [&](int begin, int end) {
        ownership.fillRows(begin, end, 1,
                           std::span(owners).subspan(static_cast<size_t>(begin) * width,
                                                     static_cast<size_t>(end - begin) * width));
    });
    return owners;
}

}  // namespace curvewall
