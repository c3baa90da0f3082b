#include "renderer/edge_neighbours.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace curvewall {
namespace {

// Edges that more triangles meet at are left without a neighbour: looking at all pairs would take for ever
// where millions meet.
constexpr size_t kMostAtAnEdge = 8;

// The first vertex at the same place, for every vertex.
std::vector<uint32_t> firstAtTheSamePlace(std::span<const glm::vec3> positions) {
    const auto place = [&](uint32_t vertex) {
        const glm::vec3& p = positions[vertex];
        return std::tie(p.x, p.y, p.z);
    };
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(
        order, [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

struct Edge {
    uint32_t low, high;  // the places that it joins
    uint32_t triangle;
    int side;  // the corner that it lies opposite to

    auto place() const { return std::tie(low, high); }
};

class Mesh {
public:
    Mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
        : positions_(positions), triangles_(triangles) {}

    std::vector<Edge> edgesByPlace() const {
        const std::vector<uint32_t> first = firstAtTheSamePlace(positions_);
        std::vector<Edge> edges;
        edges.reserve(3 * triangles_.size());
        for (uint32_t triangle = 0; triangle < triangles_.size(); ++triangle)
            for (int side = 0; side < 3; ++side) {
                const glm::uvec3 corners = triangles_[triangle];
                const auto [low, high] =
                    std::minmax({first[corners[(side + 1) % 3]], first[corners[(side + 2) % 3]]});
                edges.push_back({low, high, triangle, side});
            }
        std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.triangle, a.side) < std::tie(b.low, b.high, b.triangle, b.side);
        });
        return edges;
    }

    uint32_t cornerOff(const Edge& edge) const { return triangles_[edge.triangle][edge.side]; }

    // How flat two triangles meet: the cosine of the angle that the surface turns by at the edge, -1 where
    // they lie on each other.
    double flatness(const Edge& a, const Edge& b) const {
        const glm::dvec3 from(positions_[a.low]), along = glm::dvec3(positions_[a.high]) - from;
        const auto normalTowards = [&](const Edge& edge) {
            return glm::cross(along, glm::dvec3(positions_[cornerOff(edge)]) - from);
        };
        const glm::dvec3 na = normalTowards(a), nb = -normalTowards(b);
        const double size = glm::length(na) * glm::length(nb);
        return size > 0 ? glm::dot(na, nb) / size : 1;
    }

private:
    std::span<const glm::vec3> positions_;
    std::span<const glm::uvec3> triangles_;
};

// Where more than two triangles meet, the surface goes on with the flattest of them.
EdgeNeighbour flattestNeighbour(const Mesh& mesh, const Edge& edge, std::span<const Edge> all) {
    static const double kCreaseFlatness = std::cos(kLeastCreaseDeg * std::numbers::pi / 180);
    EdgeNeighbour flattest;
    double most = -2;
    for (const Edge& other : all) {
        const double flatness = &other == &edge ? -2 : mesh.flatness(edge, other);
        if (flatness <= most) continue;
        most = flatness;
        flattest = {mesh.cornerOff(other), flatness < kCreaseFlatness};
    }
    return flattest;
}

}  // namespace

std::vector<EdgeNeighbour> edgeNeighbours(std::span<const glm::vec3> positions,
                                          std::span<const glm::uvec3> triangles) {
    std::vector<EdgeNeighbour> neighbours(3 * triangles.size());
    const Mesh mesh(positions, triangles);
    const std::vector<Edge> edges = mesh.edgesByPlace();
    for (auto begin = edges.begin(); begin != edges.end();) {
        const auto end = std::find_if(begin, edges.end(),
                                      [&](const Edge& edge) { return edge.place() != begin->place(); });
        const std::span<const Edge> all(begin, end);
        if (all.size() <= kMostAtAnEdge)
            for (const Edge& edge : all)
                neighbours[3 * size_t{edge.triangle} + static_cast<size_t>(edge.side)] =
                    flattestNeighbour(mesh, edge, all);
        begin = end;
    }
    return neighbours;
}

}  // namespace curvewall
