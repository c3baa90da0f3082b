#pragma once
// How wide the lines of a wireframe are on a display, measured in the picture along known edges of the scene.

#include "calibration/wall.h"
#include "renderer/frame.h"
#include "renderer/scene/scene.h"
#include "tests/support/random_numbers.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace curvewall::test {

// Of a picture of white lines on black, in linear light, seen from the scene's origin.
class LineWidths {
public:
    LineWidths(const Scene& scene, const Display& display) : display_(display) {
        std::set<std::pair<std::array<float, 3>, std::array<float, 3>>> known;
        for (const glm::uvec3 triangle : scene.triangles)
            for (int i = 0; i < 3; ++i) {
                glm::vec3 a = scene.positions[triangle[i]], b = scene.positions[triangle[(i + 1) % 3]];
                if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
                if (known.insert({{a.x, a.y, a.z}, {b.x, b.y, b.z}}).second) edges_.push_back({a, b});
            }
        for (size_t edge = 0; edge < edges_.size(); ++edge)
            for (int i = 0; i <= kMarksAnEdge; ++i)
                if (const auto px = pixelOf(pointOn(edge, double(i) / kMarksAnEdge)))
                    marks_.push_back({*px, edge});
    }

    // Widths at random places of random edges, away from other lines and from the display's border.
    std::vector<double> measure(const Frame& frame, int count, Random& random) const {
        std::vector<double> widths;
        while (static_cast<int>(widths.size()) < count) {
            const auto edge = static_cast<size_t>(random.uniform(0, static_cast<double>(edges_.size())));
            const double along = random.uniform(0.02, 0.98);
            const auto px = pixelOf(pointOn(edge, along)), before = pixelOf(pointOn(edge, along - 0.01)),
                       after = pixelOf(pointOn(edge, along + 0.01));
            // The two sides of a fold, or of the border of a full turn, are not one line.
            if (!px || !before || !after || glm::distance(*before, *after) > 20 || !isClear(*px, edge))
                continue;
            widths.push_back(widthAt(frame, *px, glm::normalize(*after - *before)));
        }
        return widths;
    }

private:
    static constexpr int kMarksAnEdge = 64;
    static constexpr double kReachPx = 5;

    struct Mark {
        glm::dvec2 px;
        size_t edge;
    };

    glm::dvec3 pointOn(size_t edge, double along) const {
        return glm::mix(glm::dvec3(edges_[edge].first), glm::dvec3(edges_[edge].second), along);
    }

    std::optional<glm::dvec2> pixelOf(glm::dvec3 ray) const {
        for (const glm::dvec2 px : display_.projection->project(ray))
            if (isInside(px)) return px;
        return std::nullopt;
    }

    // With all that is looked at around it.
    bool isInside(glm::dvec2 px) const {
        constexpr double kMarginPx = kReachPx + 5;
        for (const glm::dvec2 towards : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const glm::dvec2 end = px + kMarginPx * towards;
            const bool onDisplay = glm::all(glm::greaterThan(end, glm::dvec2(0))) &&
                                   glm::all(glm::lessThan(end, glm::dvec2(display_.sizePx)));
            if (!onDisplay || !display_.projection->unproject(end)) return false;
        }
        return true;
    }

    bool isClear(glm::dvec2 px, size_t edge) const {
        return std::ranges::none_of(marks_, [&](const Mark& mark) {
            return mark.edge != edge && glm::distance(mark.px, px) < kReachPx + 7;
        });
    }

    // The light across the line, summed, and averaged over a few pixels along it.
    static double widthAt(const Frame& frame, glm::dvec2 px, glm::dvec2 tangent) {
        const glm::dvec2 normal(-tangent.y, tangent.x);
        constexpr double kStepPx = 0.1;
        double sum = 0;
        int lines = 0;
        for (double along = -2; along <= 2; along += 0.25, ++lines)
            for (double across = -kReachPx; across <= kReachPx; across += kStepPx)
                sum += kStepPx * linearlyAt(frame, px + along * tangent + across * normal);
        return sum / lines;
    }

    static double linearlyAt(const Frame& frame, glm::dvec2 px) {
        const glm::dvec2 texel = px - 0.5, first = glm::floor(texel), share = texel - first;
        const auto at = [&](int x, int y) {
            return double(frame.at(static_cast<int>(first.x) + x, static_cast<int>(first.y) + y)[0]);
        };
        return glm::mix(glm::mix(at(0, 0), at(1, 0), share.x), glm::mix(at(0, 1), at(1, 1), share.x),
                        share.y);
    }

    const Display& display_;
    std::vector<std::pair<glm::vec3, glm::vec3>> edges_;
    std::vector<Mark> marks_;
};

}  // namespace curvewall::test
