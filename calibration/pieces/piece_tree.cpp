#include "calibration/pieces/piece_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace curvewall {
namespace {

// A node wider than this about its axis is left unbounded: its planes would have to bend around the eye.
constexpr double kLeastAxisCosine = 0.1;

class TreeBuilder {
public:
    TreeBuilder(const PieceMesh& mesh, double guardPx)
        : mesh_(mesh), guardPx_(guardPx), order_(mesh.pieces.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        for (const Piece& piece : mesh.pieces) {
            std::vector<glm::dvec3> corners = guardedCorners(mesh, piece, guardPx);
            for (glm::dvec3& corner : corners) corner = glm::normalize(corner);
            corners_.push_back(std::move(corners));
        }
        add(order_);
    }

    std::vector<ConeNode> take() { return std::move(nodes_); }

private:
    void add(std::span<uint32_t> pieces) {
        const size_t self = nodes_.size();
        nodes_.emplace_back();
        if (pieces.size() == 1) {
            nodes_[self].piece = static_cast<int32_t>(pieces[0]);
            for (const glm::dvec3& plane : edgePlanes(mesh_, mesh_.pieces[pieces[0]], guardPx_))
                nodes_[self].planes[nodes_[self].planeCount++] = glm::normalize(plane);
        } else {
            boundByPlanes(nodes_[self], pieces);
            const auto middle = pieces.begin() + static_cast<std::ptrdiff_t>(pieces.size() / 2);
            const int axis = longerAxis(pieces);
            std::nth_element(pieces.begin(), middle, pieces.end(), [&](uint32_t a, uint32_t b) {
                return screenCentre(a)[axis] < screenCentre(b)[axis];
            });
            add({pieces.begin(), middle});
            add({middle, pieces.end()});
        }
        nodes_[self].next = static_cast<uint32_t>(nodes_.size());
    }

    glm::dvec2 screenCentre(uint32_t index) const {
        const Piece& piece = mesh_.pieces[index];
        glm::dvec2 sum(0);
        for (uint32_t i = 0; i < piece.vertexCount; ++i) sum += mesh_.vertices[piece.vertices[i]].s;
        return sum / static_cast<double>(piece.vertexCount);
    }

    int longerAxis(std::span<const uint32_t> pieces) const {
        glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
        for (uint32_t index : pieces) {
            least = glm::min(least, screenCentre(index));
            most = glm::max(most, screenCentre(index));
        }
        return most.x - least.x >= most.y - least.y ? 0 : 1;
    }

    // The box around the corners in the plane at distance one along the mean direction, as planes through the
    // eye.
    void boundByPlanes(ConeNode& node, std::span<const uint32_t> pieces) const {
        glm::dvec3 axis(0);
        for (uint32_t index : pieces)
            for (const glm::dvec3& corner : corners_[index]) axis += corner;
        if (!(glm::length(axis) > 0)) return;
        axis = glm::normalize(axis);
        const glm::dvec3 helper = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 side = glm::normalize(glm::cross(helper, axis));
        const glm::dvec3 up = glm::cross(axis, side);

        glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
        for (uint32_t index : pieces) {
            for (const glm::dvec3& corner : corners_[index]) {
                const double ahead = glm::dot(corner, axis);
                if (ahead < kLeastAxisCosine) return;
                const glm::dvec2 at(glm::dot(corner, side) / ahead, glm::dot(corner, up) / ahead);
                least = glm::min(least, at);
                most = glm::max(most, at);
            }
        }
        for (const glm::dvec3& plane :
             {side - least.x * axis, most.x * axis - side, up - least.y * axis, most.y * axis - up})
            node.planes[node.planeCount++] = glm::normalize(plane);
    }

    const PieceMesh& mesh_;
    double guardPx_;
    std::vector<uint32_t> order_;
    std::vector<std::vector<glm::dvec3>> corners_;  // per piece, length one
    std::vector<ConeNode> nodes_;
};

}  // namespace

std::vector<ConeNode> buildPieceTree(const PieceMesh& mesh, double guardPx) {
    return TreeBuilder(mesh, guardPx).take();
}

}  // namespace curvewall
