#pragma once
// The smallest possible replication: how many (triangle, piece) pairs a picture needs.

#include "calibration/parallel.h"
#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/piece_tree.h"
#include "renderer/camera.h"
#include "renderer/scene/scene.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace curvewall::test {

using TriangleRays = std::array<glm::dvec3, 3>;  // from the eye to the corners, in wall axes

// Planes through the eye along the true edges of a piece, without a guard; those on the display's border too.
// dot(plane, ray) >= 0 inside.
inline std::vector<glm::dvec3> trueEdgePlanes(const PieceMesh& mesh, const Piece& piece) {
    glm::dvec3 middle(0);
    for (uint32_t i = 0; i < piece.vertexCount; ++i)
        middle += glm::normalize(mesh.vertices[piece.vertices[i]].m);
    std::vector<glm::dvec3> planes;
    for (const PieceEdge& edge : edgesOf(mesh, piece)) {
        const glm::dvec3 plane = glm::normalize(
            glm::cross(mesh.vertices[piece.vertices[edge.from]].m, mesh.vertices[piece.vertices[edge.to]].m));
        planes.push_back(glm::dot(plane, middle) < 0 ? -plane : plane);
    }
    return planes;
}

// Whether the directions to a triangle's inside and those within all planes have more in common than a
// border. Cuts the triangle by one plane after the other (Sutherland and Hodgman, 1974) where it lies in
// space, so that points behind the eye are like any others.
inline bool touches(const TriangleRays& triangle, const std::vector<glm::dvec3>& planes) {
    std::array<glm::dvec3, 3 + kMostPieceEdges> left, cut;
    std::ranges::copy(triangle, left.begin());
    size_t count = 3;
    for (const glm::dvec3& plane : planes) {
        size_t kept = 0;
        bool hasInside = false;
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec3 from = left[i], to = left[(i + 1) % count];
            const double before = glm::dot(plane, from), after = glm::dot(plane, to);
            hasInside = hasInside || before > 0;
            if (before >= 0) cut[kept++] = from;
            if ((before < 0 && after > 0) || (before > 0 && after < 0))
                cut[kept++] = from + (to - from) * (before / (before - after));
        }
        if (!hasInside) return false;
        left = cut;
        count = kept;
    }
    return true;
}

struct ExactPairs {
    uint64_t pairs = 0;
    uint64_t triangles = 0;  // that touch a piece
};

// Counts pairs of a triangle whose drawn side faces the eye (its back too where the material is double-sided)
// and a piece whose true cone it touches, seen where it is and not whether something hides it. The near cut
// is left out of account. A triangle that is seen edge-on needs no pair. All in double.
class ExactPairCounter {
public:
    // Both must outlive this.
    ExactPairCounter(const Scene& scene, const PieceMesh& mesh)
        : scene_(scene), tree_(buildPieceTree(mesh)), doubleSided_(scene.triangles.size()) {
        for (const Piece& piece : mesh.pieces) planes_.push_back(trueEdgePlanes(mesh, piece));
        for (const MaterialRange& range : scene.ranges)
            std::fill_n(doubleSided_.begin() + range.firstTriangle, range.triangleCount,
                        scene.materials[range.material].doubleSided ? 1 : 0);
    }

    ExactPairs count(const Camera& camera, glm::dvec3 eyeInWallM) const {
        const glm::dmat3 wallFromScene = glm::transpose(rotationFromOrientation(camera.orientation));
        const glm::dvec3 originFromEyeM = scene_.originM - eyeInScene(camera, eyeInWallM);
        std::atomic<uint64_t> pairs = 0, triangles = 0;
        parallelRanges(static_cast<int>(scene_.triangles.size()), [&](int begin, int end) {
            ExactPairs own;
            for (auto i = static_cast<size_t>(begin); i < static_cast<size_t>(end); ++i) {
                TriangleRays rays;
                for (int k = 0; k < 3; ++k)
                    rays[static_cast<size_t>(k)] =
                        wallFromScene *
                        (glm::dvec3(scene_.positions[scene_.triangles[i][k]]) + originFromEyeM);
                const uint64_t found = isSeen(rays, doubleSided_[i] != 0) ? piecesOf(rays) : 0;
                own.pairs += found;
                own.triangles += found > 0;
            }
            pairs += own.pairs;
            triangles += own.triangles;
        });
        return {pairs, triangles};
    }

private:
    static bool isSeen(const TriangleRays& rays, bool doubleSided) {
        const auto& [a, b, c] = rays;
        const double side = glm::dot(a, glm::cross(b - a, c - a));
        return side < 0 || (doubleSided && side > 0);
    }

    uint64_t piecesOf(const TriangleRays& rays) const {
        uint64_t found = 0;
        for (size_t i = 0; i < tree_.size();) {
            const ConeNode& node = tree_[i];
            const bool outside = std::any_of(
                node.planes.begin(), node.planes.begin() + node.planeCount, [&](const glm::dvec3& plane) {
                    return std::ranges::all_of(
                        rays, [&](const glm::dvec3& ray) { return glm::dot(plane, ray) < 0; });
                });
            if (!outside && node.piece >= 0) found += touches(rays, planes_[static_cast<size_t>(node.piece)]);
            i = outside ? node.next : i + 1;
        }
        return found;
    }

    const Scene& scene_;
    std::vector<ConeNode> tree_;
    std::vector<std::vector<glm::dvec3>> planes_;  // of each piece
    std::vector<uint8_t> doubleSided_;             // of each triangle
};

}  // namespace curvewall::test
