#include "calibration/blending/distance_map.h"

#include "calibration/parallel.h"

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Along one column, to the nearest marked pixel of that column.
void columnDistances(const std::vector<uint8_t>& marked, glm::ivec2 sizePx, int x, std::vector<float>& out) {
    const auto at = [&](int y) {
        return static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x);
    };
    float distance = kInfinity;
    for (int y = 0; y < sizePx.y; ++y) out[at(y)] = distance = marked[at(y)] ? 0 : distance + 1;
    distance = kInfinity;
    for (int y = sizePx.y - 1; y >= 0; --y) {
        distance = marked[at(y)] ? 0 : distance + 1;
        out[at(y)] = std::min(out[at(y)], distance);
    }
}

// One of the parabolas (x - column)^2 + height whose lower envelope is the squared distance.
struct Parabola {
    int column;
    double height;
    double from;  // it is the lowest one from here to where the next begins
};

// Where parabola b, which lies further right, gets below a.
double crossing(const Parabola& a, const Parabola& b) {
    const double columnA = a.column, columnB = b.column;
    return (b.height - a.height + columnB * columnB - columnA * columnA) / (2 * (columnB - columnA));
}

// From distances along the columns to distances in the plane.
void rowDistances(float* row, int width, std::vector<Parabola>& envelope) {
    envelope.clear();
    for (int x = 0; x < width; ++x) {
        if (std::isinf(row[x])) continue;
        Parabola next{x, static_cast<double>(row[x]) * row[x], -std::numeric_limits<double>::infinity()};
        while (!envelope.empty()) {
            next.from = crossing(envelope.back(), next);
            if (next.from > envelope.back().from) break;
            envelope.pop_back();
            next.from = -std::numeric_limits<double>::infinity();
        }
        envelope.push_back(next);
    }
    if (envelope.empty()) return;
    auto lowest = envelope.begin();
    for (int x = 0; x < width; ++x) {
        while (lowest + 1 != envelope.end() && (lowest + 1)->from <= x) ++lowest;
        const double along = x - lowest->column;
        row[x] = static_cast<float>(std::sqrt(along * along + lowest->height));
    }
}

}  // namespace

// Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions (2012).
std::vector<float> distancesToMarked(const std::vector<uint8_t>& marked, glm::ivec2 sizePx) {
    std::vector<float> distances(marked.size());
    parallelRanges(sizePx.x, [&](int begin, int end) {
        for (int x = begin; x < end; ++x) columnDistances(marked, sizePx, x, distances);
    });
    parallelRanges(sizePx.y, [&](int begin, int end) {
        std::vector<Parabola> envelope;
        for (int y = begin; y < end; ++y)
            rowDistances(&distances[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x)], sizePx.x,
                         envelope);
    });
    return distances;
}

}  // namespace curvewall
