#include "renderer/position_table.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace curvewall {
namespace {

constexpr int kFewestNodes = 32, kMostNodes = 1024;  // along a side
constexpr glm::dvec2 kNowhere(std::numeric_limits<double>::quiet_NaN());

bool isSomewhere(glm::dvec2 px) { return !std::isnan(px.x); }

UsageError refusal(const Display& display, const std::string& why) {
    return UsageError("vertex-warp moves every vertex to one place, and display \"" + display.name + "\" " +
                      why + "; piecewise draws it");
}

bool isWithin(glm::dvec2 px, glm::ivec2 sizePx) {
    return glm::all(glm::greaterThanEqual(px, glm::dvec2(0))) &&
           glm::all(glm::lessThan(px, glm::dvec2(sizePx)));
}

// The box of all rays in the chart, and two nodes around it.
void layOut(PositionTable& table, const PixelRays& rays) {
    constexpr int kApron = 2;
    glm::dvec2 least(std::numeric_limits<double>::infinity()), most = -least;
    for (int y = 0; y < rays.sizePx().y; ++y)
        for (int x = 0; x < rays.sizePx().x; ++x) {
            const glm::dvec3 ray = rays.at({x, y});
            if (!PixelRays::isRay(ray)) continue;
            const glm::dvec2 position = table.chart.position(ray);
            least = glm::min(least, position);
            most = glm::max(most, position);
        }
    const int side = std::clamp(std::max(rays.sizePx().x, rays.sizePx().y) / 2, kFewestNodes, kMostNodes);
    table.nodes = glm::ivec2(side);
    const glm::dvec2 step =
        glm::max(most - least, glm::dvec2(1e-9)) / glm::dvec2(table.nodes - 1 - 2 * kApron);
    table.least = least - static_cast<double>(kApron) * step;
    table.nodesPerUnit = 1.0 / step;
}

// The place within the display where there is one; nothing where the projection knows none.
std::optional<glm::dvec2> placeOf(const Display& display, glm::dvec3 ray, bool& isAmbiguous) {
    std::optional<glm::dvec2> place;
    for (const glm::dvec2 px : display.projection->project(ray)) {
        const bool shown = isWithin(px, display.sizePx);
        if (place && isWithin(*place, display.sizePx)) {
            isAmbiguous = isAmbiguous || (shown && glm::distance(px, *place) > 0.5);
            continue;
        }
        if (!place || shown) place = px;
    }
    return place;
}

// How many nodes have several places.
int fill(PositionTable& table, const Display& display) {
    table.px.assign(static_cast<size_t>(table.nodes.x) * static_cast<size_t>(table.nodes.y), kNowhere);
    std::atomic<int> ambiguous = 0;
    parallelRanges(table.nodes.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < table.nodes.x; ++x) {
                const glm::dvec2 position = table.least + glm::dvec2(x, y) / table.nodesPerUnit;
                if (!table.chart.isPlane && glm::length(position) > std::numbers::pi) continue;
                bool isAmbiguous = false;
                const auto place = placeOf(display, table.chart.direction(position), isAmbiguous);
                ambiguous += isAmbiguous;
                if (place)
                    table.px[static_cast<size_t>(y) * static_cast<size_t>(table.nodes.x) +
                             static_cast<size_t>(x)] = *place;
            }
    });
    return ambiguous;
}

// The affine map nearest to the table, by least squares; its linear part.
glm::dmat2 overallMap(const PositionTable& table) {
    glm::dvec2 meanChart(0), meanPx(0);
    double count = 0;
    const auto forEach = [&](const auto& use) {
        for (int y = 0; y < table.nodes.y; ++y)
            for (int x = 0; x < table.nodes.x; ++x) {
                const glm::dvec2 px = table.px[static_cast<size_t>(y) * static_cast<size_t>(table.nodes.x) +
                                               static_cast<size_t>(x)];
                if (isSomewhere(px)) use(glm::dvec2(x, y) / table.nodesPerUnit, px);
            }
    };
    forEach([&](glm::dvec2 chart, glm::dvec2 px) {
        meanChart += chart;
        meanPx += px;
        ++count;
    });
    meanChart /= std::max(count, 1.0);
    meanPx /= std::max(count, 1.0);
    glm::dmat2 across(0), within(0);
    forEach([&](glm::dvec2 chart, glm::dvec2 px) {
        across += glm::outerProduct(px - meanPx, chart - meanChart);
        within += glm::outerProduct(chart - meanChart, chart - meanChart);
    });
    return across * glm::inverse(within);
}

// Gives places to the nodes beside those that have one: straight on for two rings, so that cells on the
// display's border are right, and by the overall map from there.
void goOnOutwards(PositionTable& table) {
    constexpr int kStraightRings = 2;
    const auto index = [&](glm::ivec2 at) {
        return static_cast<size_t>(at.y) * static_cast<size_t>(table.nodes.x) + static_cast<size_t>(at.x);
    };
    const auto known = [&](const std::vector<glm::dvec2>& px, glm::ivec2 at) {
        return at.x >= 0 && at.y >= 0 && at.x < table.nodes.x && at.y < table.nodes.y &&
               isSomewhere(px[index(at)]);
    };
    std::vector<glm::ivec2> open;
    for (int y = 0; y < table.nodes.y; ++y)
        for (int x = 0; x < table.nodes.x; ++x)
            if (!isSomewhere(table.px[index({x, y})])) open.emplace_back(x, y);
    for (int ring = 0; !open.empty(); ++ring) {
        const std::vector<glm::dvec2> before = table.px;
        std::erase_if(open, [&](glm::ivec2 at) {
            glm::dvec2 sum(0);
            double count = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const glm::ivec2 step(dx, dy);
                    if (!known(before, at + step)) continue;
                    const glm::dvec2 next = before[index(at + step)];
                    if (ring < kStraightRings && known(before, at + 2 * step))
                        sum += 2.0 * next - before[index(at + 2 * step)];
                    else if (ring >= kStraightRings)
                        sum += next - table.pxFromChart * (glm::dvec2(step) / table.nodesPerUnit);
                    else
                        continue;
                    ++count;
                }
            if (count > 0) table.px[index(at)] = sum / count;
            return count > 0;
        });
    }
}

// The share of pixels, on a lattice, that the table has elsewhere.
double shareElsewhere(const PositionTable& table, const PixelRays& rays) {
    constexpr double kMostPx = 1;
    const glm::ivec2 step = glm::max(rays.sizePx() / 96, 1);
    double count = 0, off = 0;
    for (int y = 0; y < rays.sizePx().y; y += step.y)
        for (int x = 0; x < rays.sizePx().x; x += step.x) {
            const glm::dvec3 ray = rays.at({x, y});
            if (!PixelRays::isRay(ray)) continue;
            ++count;
            off += !(glm::distance(table.at(ray), centreOf({x, y})) < kMostPx);
        }
    return off / std::max(count, 1.0);
}

}  // namespace

glm::dvec2 DirectionChart::position(glm::dvec3 ray) const {
    const glm::dvec3 d = chartFromWall * ray;
    if (isPlane) return glm::dvec2(d) / -d.z;
    const double offAxis = std::hypot(d.x, d.y);
    return offAxis > 0 ? glm::dvec2(d) * (std::atan2(offAxis, -d.z) / offAxis) : glm::dvec2(0);
}

glm::dvec3 DirectionChart::direction(glm::dvec2 position) const {
    if (isPlane) return glm::transpose(chartFromWall) * glm::dvec3(position, -1);
    const double angle = glm::length(position);
    const glm::dvec2 side = angle > 0 ? position / angle : glm::dvec2(0);
    return glm::transpose(chartFromWall) * glm::dvec3(std::sin(angle) * side, -std::cos(angle));
}

glm::dmat3 chartFromWallAbout(glm::dvec3 axis) {
    const glm::dvec3 aside = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, aside));
    return glm::transpose(glm::dmat3(right, glm::cross(right, axis), -axis));
}

glm::dvec2 PositionTable::at(glm::dvec3 ray) const {
    const glm::dvec2 node = (chart.position(ray) - least) * nodesPerUnit;
    const glm::dvec2 inside = glm::clamp(node, glm::dvec2(0), glm::dvec2(nodes - 1));
    const glm::ivec2 corner = glm::min(glm::ivec2(inside), nodes - 2);
    const glm::dvec2 st = inside - glm::dvec2(corner);
    const glm::dvec2* above =
        &px[static_cast<size_t>(corner.y) * static_cast<size_t>(nodes.x) + static_cast<size_t>(corner.x)];
    const glm::dvec2* below = above + nodes.x;
    return glm::mix(glm::mix(above[0], above[1], st.x), glm::mix(below[0], below[1], st.x), st.y) +
           pxFromChart * ((node - inside) / nodesPerUnit);
}

PositionTable samplePositions(const Display& display, const PixelRays& rays, const DirectionChart& chart) {
    constexpr double kMostShareElsewhere = 0.02;
    PositionTable table;
    table.chart = chart;
    layOut(table, rays);
    const int ambiguous = fill(table, display);
    if (std::ranges::none_of(table.px, isSomewhere)) throw refusal(display, "shows nothing");
    const double mostAmbiguous = 1e-3 * static_cast<double>(table.px.size());
    if (ambiguous > mostAmbiguous) throw refusal(display, "shows some directions at several");
    table.pxFromChart = overallMap(table);
    goOnOutwards(table);
    if (shareElsewhere(table, rays) > kMostShareElsewhere) throw refusal(display, "tears its picture");
    return table;
}

}  // namespace curvewall
