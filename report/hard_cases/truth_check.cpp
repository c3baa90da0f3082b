#include "report/hard_cases/truth_check.h"

#include "calibration/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace curvewall {
namespace {

// What single precision may see otherwise: an edge by as many radians, and as much of a length.
constexpr double kEdgeDoubtRad = 1e-5, kLengthDoubt = 2e-6;
constexpr double kNearShareOfWall = 1e-5;  // nearer than this share of the distance to the wall all is cut
constexpr double kMostTests = 4e7;         // a second or so

enum class Met { no, doubtful, yes };

// A triangle seen from the eye, in wall axes.
class SeenTriangle {
public:
    explicit SeenTriangle(std::array<glm::dvec3, 3> corners) {
        const auto nearest =
            std::ranges::min_element(corners, {}, [](glm::dvec3 corner) { return glm::length(corner); });
        std::rotate(corners.begin(), nearest, corners.end());
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = corners[i], to = corners[(i + 1) % 3];
            planes_[i] = glm::cross(from, to - from);
            const double nearer = std::min(glm::length(from), glm::length(to));
            doubts_[i] = std::max(kEdgeDoubtRad * glm::length(planes_[i]),
                                  kLengthDoubt * nearer * glm::distance(from, to));
        }
        const glm::dvec3 second = corners[1] - corners[0], third = corners[2] - corners[0];
        normal_ = glm::cross(second, third);
        side_ = glm::dot(corners[0], normal_);
        sideDoubt_ = kLengthDoubt * glm::length(corners[0]) * glm::length(second) * glm::length(third);
    }

    // Where a ray of length one meets the plane, and how far that may be off.
    struct Distance {
        double m = 0, doubtM = 0;
    };
    Met meets(glm::dvec3 ray, Distance& distance) const {
        int above = 0, below = 0;
        for (size_t i = 0; i < 3; ++i) {
            const double volume = glm::dot(ray, planes_[i]);
            above += volume > doubts_[i];
            below += volume < -doubts_[i];
        }
        if (above > 0 && below > 0) return Met::no;
        const double slope = glm::dot(normal_, ray);
        distance.m = side_ / slope;
        distance.doubtM = std::abs(distance.m) * (1e-3 + std::abs(sideDoubt_ / side_) +
                                                  kLengthDoubt * glm::length(normal_) / std::abs(slope));
        if (!(std::abs(side_) > sideDoubt_)) return Met::doubtful;
        if ((side_ > 0 ? below : above) > 0) return Met::no;
        return above + below == 3 ? Met::yes : Met::doubtful;
    }

private:
    std::array<glm::dvec3, 3> planes_;
    std::array<double, 3> doubts_;
    glm::dvec3 normal_;
    double side_, sideDoubt_;
};

std::vector<SeenTriangle> seenTriangles(const HardCase& tried) {
    const Scene& scene = *tried.scene;
    const glm::dmat3 wallFromScene = glm::transpose(rotationFromOrientation(tried.camera.orientation));
    const glm::dvec3 originM = scene.originM - eyeInScene(tried.camera, tried.wall->eyeM);
    std::vector<SeenTriangle> seen;
    for (const glm::uvec3 triangle : scene.triangles) {
        std::array<glm::dvec3, 3> corners;
        for (glm::length_t i = 0; i < 3; ++i)
            corners[static_cast<size_t>(i)] =
                wallFromScene * (originM + glm::dvec3(scene.positions[triangle[i]]));
        seen.emplace_back(corners);
    }
    return seen;
}

// Whether a ray that shows a point that far away, or none, shows what it should.
Met isRight(const std::vector<SeenTriangle>& triangles, glm::dvec3 toWall, double shownM) {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const double nearM = kNearShareOfWall * glm::length(toWall);
    const glm::dvec3 ray = glm::normalize(toWall);
    SeenTriangle::Distance nearest{kNowhere, 0};
    double doubtfulM = kNowhere;
    for (const SeenTriangle& triangle : triangles) {
        SeenTriangle::Distance distance;
        const Met met = triangle.meets(ray, distance);
        if (met == Met::no || distance.m < 0.9 * nearM) continue;
        if (met == Met::doubtful || distance.m < 1.1 * nearM)
            doubtfulM = std::min(doubtfulM, std::isfinite(distance.m) ? distance.m - distance.doubtM : 0);
        else if (distance.m < nearest.m)
            nearest = distance;
    }
    const bool agrees =
        std::isfinite(shownM) ? std::abs(shownM - nearest.m) <= nearest.doubtM : nearest.m == kNowhere;
    if (agrees) return Met::yes;
    const bool mayHide = std::isfinite(doubtfulM) && doubtfulM <= nearest.m + nearest.doubtM;
    return mayHide ? Met::doubtful : Met::no;
}

}  // namespace

TruthCheck checkTruth(const Frame& position, const HardCase& tried) {
    const std::vector<SeenTriangle> triangles = seenTriangles(tried);
    const Projection& projection = *tried.wall->displays.front().projection;
    const int64_t pixels = static_cast<int64_t>(position.sizePx.x) * position.sizePx.y;
    const auto every = static_cast<int64_t>(1 + static_cast<double>(pixels) *
                                                    static_cast<double>(triangles.size()) / kMostTests);
    std::atomic<uint64_t> checked = 0, doubtful = 0, wrong = 0;
    parallelRanges(static_cast<int>((pixels + every - 1) / every), [&](int begin, int end) {
        for (int64_t i = begin * every; i < std::min(end * every, pixels); i += every) {
            const auto x = static_cast<int>(i % position.sizePx.x),
                       y = static_cast<int>(i / position.sizePx.x);
            const auto toWall = projection.unproject({x + 0.5, y + 0.5});
            if (!toWall) continue;
            ++checked;
            const float* const p = position.at(x, y);
            const Met right = isRight(triangles, *toWall, glm::length(glm::dvec3(p[0], p[1], p[2])));
            doubtful += right == Met::doubtful;
            wrong += right == Met::no;
        }
    });
    return {checked, doubtful, wrong};
}

}  // namespace curvewall
