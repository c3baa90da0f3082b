#pragma once
// A tree over the pieces for the question "which pieces can this geometry touch?".

#include "calibration/pieces/piece_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace curvewall {

// Nodes in depth-first order. Geometry that lies outside one of a node's planes (dot(plane, ray) < 0 for all
// of its points) touches nothing below it: go on at `next`. Otherwise go on with the following node; a leaf's
// piece is touched.
struct ConeNode {
    std::array<glm::dvec3, kMostPieceEdges> planes{};  // through the eye, length one; then zeros
    uint32_t planeCount = 0;                           // none where a node is too wide to bound
    uint32_t next = 0;                                 // the node after this one's subtree
    int32_t piece = -1;                                // of a leaf
};

// Leaves are bounded by their piece's edgePlanes, inner nodes by four planes about all pieces below.
std::vector<ConeNode> buildPieceTree(const PieceMesh& mesh, double guardPx = kGuardPx);

}  // namespace curvewall
