#include "calibration/pieces/plane_envelope.h"

#include <glm/geometric.hpp>
extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace curvewall {
namespace {

constexpr double kSamePx = 1e-9;
constexpr double kSquarePx = 1e-6;  // by which places are found again

struct FileClose {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

// The triangles on the lower side of the convex hull of points (x, y, z), three each.
std::vector<std::array<uint32_t, 3>> lowerHull(std::vector<double> points) {
    // What fails is told below and not on stderr.
    const std::unique_ptr<std::FILE, FileClose> silence(std::fopen("/dev/null", "w"));
    if (!silence) throw std::runtime_error("/dev/null cannot be opened");
    // Its macros want the name qh.
    qhT state, *const qh = &state;
    qh_zero(qh, silence.get());
    std::string options = "qhull Qt";
    const int failure = qh_new_qhull(qh, 3, static_cast<int>(points.size() / 3), points.data(), False,
                                     options.data(), nullptr, silence.get());
    std::vector<std::array<uint32_t, 3>> triangles;
    const auto collect = [&] {
        facetT* facet = nullptr;
        FORALLfacets {
            if (!(facet->normal[2] < 0)) continue;
            std::array<uint32_t, 3> triangle{};
            for (int i = 0; i < 3; ++i) {
                const auto* vertex = static_cast<const vertexT*>(SETelem_(facet->vertices, i));
                triangle[static_cast<size_t>(i)] = static_cast<uint32_t>(qh_pointid(qh, vertex->point));
            }
            triangles.push_back(triangle);
        }
    };
    if (failure == 0) collect();
    qh_freeqhull(qh, qh_ALL);
    if (failure != 0) throw std::domain_error("planes that have no hull");
    return triangles;
}

// A plane is lowest at s where its dual point (b, a) is extreme in the direction -(s, 1). So the planes of
// the envelope are the lower side of the dual points' convex hull, and those that share an edge there meet.
std::vector<std::vector<uint32_t>> neighboursOf(const std::vector<HeightPlane>& planes) {
    std::vector<std::vector<uint32_t>> neighbours(planes.size());
    const auto join = [&](uint32_t a, uint32_t b) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    };
    if (planes.size() < 5) {
        for (uint32_t a = 0; a < planes.size(); ++a)
            for (uint32_t b = 0; b < a; ++b) join(a, b);
        return neighbours;
    }
    std::vector<double> points;
    for (const HeightPlane& plane : planes)
        points.insert(points.end(), {plane.slope.x, plane.slope.y, plane.atOrigin});
    for (const auto& [a, b, c] : lowerHull(std::move(points))) {
        join(a, b);
        join(b, c);
        join(c, a);
    }
    for (auto& each : neighbours) {
        std::ranges::sort(each);
        each.erase(std::unique(each.begin(), each.end()), each.end());
    }
    return neighbours;
}

// Keeps the part of a convex polygon where the height of `over` is at least that of `under`.
void clip(std::vector<glm::dvec2>& polygon, const HeightPlane& under, const HeightPlane& over) {
    std::vector<glm::dvec2> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        const double a = over.at(from) - under.at(from), b = over.at(to) - under.at(to);
        if (a >= 0) kept.push_back(from);
        if ((a < 0) != (b < 0)) kept.push_back(glm::mix(from, to, a / (a - b)));
    }
    polygon = std::move(kept);
}

uint64_t keyOf(glm::i64vec2 square) {
    return static_cast<uint64_t>(square.x) * 0x9E3779B97F4A7C15u + static_cast<uint64_t>(square.y);
}

}  // namespace

uint32_t PlacesPx::numberOf(glm::dvec2 px) {
    // Nearly always one square.
    const glm::i64vec2 first(glm::floor((px - kSamePx) / kSquarePx)),
        last(glm::floor((px + kSamePx) / kSquarePx));
    for (int64_t y = first.y; y <= last.y; ++y) {
        for (int64_t x = first.x; x <= last.x; ++x) {
            const auto [begin, end] = numbers_.equal_range(keyOf({x, y}));
            for (auto it = begin; it != end; ++it)
                if (glm::distance(places_[it->second], px) <= kSamePx) return it->second;
        }
    }
    const auto number = static_cast<uint32_t>(places_.size());
    places_.push_back(px);
    numbers_.emplace(keyOf(glm::i64vec2(glm::floor(px / kSquarePx))), number);
    return number;
}

PlaneEnvelope lowestPlanes(const std::vector<HeightPlane>& planes, glm::ivec2 sizePx) {
    const std::vector<std::vector<uint32_t>> neighbours = neighboursOf(planes);
    const glm::dvec2 size(sizePx);
    PlaneEnvelope envelope;
    envelope.cells.resize(planes.size());
    PlacesPx places;
    for (uint32_t k = 0; k < planes.size(); ++k) {
        // One that is on no lower facet is nowhere lowest.
        if (neighbours[k].empty() && planes.size() > 1) continue;
        std::vector<glm::dvec2> polygon{{0, 0}, {size.x, 0}, size, {0, size.y}};
        for (uint32_t other : neighbours[k]) clip(polygon, planes[k], planes[other]);
        std::vector<uint32_t>& cell = envelope.cells[k];
        for (glm::dvec2 px : polygon) {
            const uint32_t corner = places.numberOf(px);
            if (cell.empty() || (cell.back() != corner && cell.front() != corner)) cell.push_back(corner);
        }
        if (cell.size() < 3) cell.clear();
    }
    envelope.corners = places.all();
    return envelope;
}

}  // namespace curvewall
