#pragma once
// Pieces by plain geometry in double precision, without the code that fits, owns or certifies them.

#include "calibration/pieces/piece_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace curvewall::test {

inline double cross2(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

inline const PieceVertex& cornerOf(const PieceMesh& mesh, const Piece& piece, size_t i) {
    return mesh.vertices[piece.vertices[i % piece.vertexCount]];
}

// Three corners of a piece that span a large part of it. Any three give the same facet, but those of a sliver
// give it badly.
inline std::array<PieceVertex, 3> widestCorners(const PieceMesh& mesh, const Piece& piece) {
    const auto corner = [&](size_t i) { return cornerOf(mesh, piece, i); };
    std::array<PieceVertex, 3> widest{corner(0), corner(1), corner(2)};
    double largest = 0;
    for (size_t j = 1; j + 1 < piece.vertexCount; ++j) {
        for (size_t k = j + 1; k < piece.vertexCount; ++k) {
            const double area = std::abs(cross2(corner(j).s - corner(0).s, corner(k).s - corner(0).s));
            if (area <= largest) continue;
            largest = area;
            widest = {corner(0), corner(j), corner(k)};
        }
    }
    return widest;
}

// Where a ray meets the plane of the facet, on the screen; not a number where it points away from it.
inline glm::dvec2 landing(const PieceMesh& mesh, const Piece& piece, glm::dvec3 ray) {
    const auto [a, b, c] = widestCorners(mesh, piece);
    const glm::dvec3 blend = glm::inverse(glm::dmat3(a.m, b.m, c.m)) * ray;
    const double sum = blend.x + blend.y + blend.z;
    if (!(sum > 0)) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    return (blend.x * a.s + blend.y * b.s + blend.z * c.s) / sum;
}

// The ray that a piece shows at a screen position, as the point of its facet.
inline glm::dvec3 shownRay(const PieceMesh& mesh, const Piece& piece, glm::dvec2 px) {
    const auto [a, b, c] = widestCorners(mesh, piece);
    const double area = cross2(b.s - a.s, c.s - a.s);
    const double u = cross2(px - a.s, c.s - a.s) / area, v = cross2(b.s - a.s, px - a.s) / area;
    return a.m + u * (b.m - a.m) + v * (c.m - a.m);
}

// How far within a piece a screen position is: the distance from its nearest edge line, negative outside.
inline double depthInside(const PieceMesh& mesh, const Piece& piece, glm::dvec2 px) {
    const auto [a, b, c] = widestCorners(mesh, piece);
    const double turn = cross2(b.s - a.s, c.s - a.s) > 0 ? 1 : -1;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < piece.vertexCount; ++i) {
        const glm::dvec2 from = cornerOf(mesh, piece, i).s, along = cornerOf(mesh, piece, i + 1).s - from;
        least = std::min(least, turn * cross2(along, px - from) / glm::length(along));
    }
    return least;
}

// Things by the square of the display that they touch, so that finding what is at a place takes no search.
class ScreenBuckets {
public:
    ScreenBuckets(glm::ivec2 sizePx, double sidePx)
        : sidePx_(sidePx), counts_(glm::max(glm::ivec2(glm::ceil(glm::dvec2(sizePx) / sidePx)), 1)) {
        buckets_.resize(static_cast<size_t>(counts_.x) * static_cast<size_t>(counts_.y));
    }

    void add(uint32_t thing, glm::dvec2 least, glm::dvec2 most) {
        const glm::ivec2 from = bucketAt(least), to = bucketAt(most);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) buckets_[indexOf({x, y})].push_back(thing);
    }

    const std::vector<uint32_t>& at(glm::dvec2 px) const { return buckets_[indexOf(bucketAt(px))]; }
    const std::vector<std::vector<uint32_t>>& all() const { return buckets_; }

private:
    glm::ivec2 bucketAt(glm::dvec2 px) const {
        return glm::clamp(glm::ivec2(glm::floor(px / sidePx_)), glm::ivec2(0), counts_ - 1);
    }
    size_t indexOf(glm::ivec2 bucket) const {
        return static_cast<size_t>(bucket.y) * static_cast<size_t>(counts_.x) + static_cast<size_t>(bucket.x);
    }

    double sidePx_;
    glm::ivec2 counts_;
    std::vector<std::vector<uint32_t>> buckets_;
};

// About as wide as the pieces are.
inline double bucketSidePx(const PieceMesh& mesh) {
    const double area = static_cast<double>(mesh.sizePx.x) * static_cast<double>(mesh.sizePx.y);
    return std::max(4.0, std::sqrt(area / static_cast<double>(mesh.pieces.size())));
}

inline ScreenBuckets piecesByPlace(const PieceMesh& mesh) {
    ScreenBuckets buckets(mesh.sizePx, bucketSidePx(mesh));
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k) {
        glm::dvec2 least = cornerOf(mesh, mesh.pieces[k], 0).s, most = least;
        for (size_t i = 1; i < mesh.pieces[k].vertexCount; ++i) {
            least = glm::min(least, cornerOf(mesh, mesh.pieces[k], i).s);
            most = glm::max(most, cornerOf(mesh, mesh.pieces[k], i).s);
        }
        buckets.add(k, least, most);
    }
    return buckets;
}

}  // namespace curvewall::test
