#include "calibration/blending/blend_masks.h"

#include "calibration/blending/distance_map.h"
#include "calibration/parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace curvewall {
namespace {

// A neighbour that reaches less than this further ends at the same place: no pixel centre of it lies beyond.
constexpr double kSameBorderPx = 0.5;

// More of them serve the pixel centres at the cost of what lies between: measured on random walls, four leave
// the fewest rays off near the crossings of borders without adding any elsewhere.
constexpr int kLevellingRounds = 4;

constexpr double kVisible = 0.01;  // a deviation that counts in BlendSum::shareOff

constexpr float kPng16Steps = 65535;

// One number a pixel.
struct Grid {
    explicit Grid(glm::ivec2 size)
        : sizePx(size), values(static_cast<size_t>(size.x) * static_cast<size_t>(size.y)) {}

    float& at(int x, int y) { return values[indexOf(x, y)]; }
    float at(int x, int y) const { return values[indexOf(x, y)]; }
    size_t indexOf(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x);
    }

    // Between pixel centres; beyond the outermost ones theirs.
    double bilinear(glm::dvec2 px) const {
        const glm::dvec2 p = glm::clamp(px - 0.5, glm::dvec2(0), glm::dvec2(sizePx - 1));
        const glm::ivec2 low(p), high = glm::min(low + 1, sizePx - 1);
        const glm::dvec2 f = p - glm::dvec2(low);
        return glm::mix(glm::mix<double>(at(low.x, low.y), at(high.x, low.y), f.x),
                        glm::mix<double>(at(low.x, high.y), at(high.x, high.y), f.x), f.y);
    }

    glm::ivec2 sizePx;
    std::vector<float> values;
};

// Another display that shows what a pixel's centre shows.
struct Overlap {
    int x;  // of the pixel, in its row
    uint32_t display;
    glm::vec2 px;  // there
};

// One display of the wall while its mask is made.
struct Masked {
    explicit Masked(const Display& shown)
        : display(&shown),
          hasRay(shown.sizePx),
          distancesPx(shown.sizePx + 2),
          overlaps(static_cast<size_t>(shown.sizePx.y)),
          mask(shown.sizePx) {}

    const Display* display;
    Grid hasRay;          // of the pixel's centre: 1 or 0
    double pixelRad = 1;  // side of an average pixel
    Grid distancesPx;     // to where the display ends within another one; with a ring of pixels around it
    std::vector<std::vector<Overlap>> overlaps;  // by row, by x
    Grid mask;

    glm::ivec2 sizePx() const { return display->sizePx; }
    std::optional<glm::dvec3> rayAt(glm::dvec2 px) const { return display->projection->unproject(px); }
};

void forEachRow(const Masked& masked, const std::function<void(int y)>& work) {
    parallelRanges(masked.sizePx().y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) work(y);
    });
}

double averagePixelRad(const Masked& masked) {
    constexpr int kPlaces = 16;  // along each side
    double solidAngle = 0;
    int count = 0;
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
        const glm::dvec2 px = glm::dvec2(masked.sizePx()) * (glm::dvec2(i % kPlaces, i / kPlaces) + 0.5) /
                              static_cast<double>(kPlaces);
        const auto ray = masked.rayAt(px), right = masked.rayAt(px + glm::dvec2(1, 0)),
                   below = masked.rayAt(px + glm::dvec2(0, 1));
        if (!ray || !right || !below) continue;
        const glm::dvec3 unit = glm::normalize(*ray);
        solidAngle += glm::length(glm::cross(glm::normalize(*right) - unit, glm::normalize(*below) - unit));
        ++count;
    }
    return solidAngle > 0 ? std::sqrt(solidAngle / count) : 1;
}

void findRays(Masked& masked) {
    forEachRow(masked, [&](int y) {
        for (int x = 0; x < masked.sizePx().x; ++x)
            masked.hasRay.at(x, y) = masked.rayAt({x + 0.5, y + 0.5}) ? 1 : 0;
    });
    masked.pixelRad = averagePixelRad(masked);
}

// True where the display lights its position `px` and goes on for `marginPx` beyond it.
bool lights(const Masked& masked, glm::dvec2 px, double marginPx) {
    const glm::dvec2 size(masked.sizePx());
    // NaN is not.
    if (!(px.x >= marginPx && px.y >= marginPx && px.x <= size.x - marginPx && px.y <= size.y - marginPx))
        return false;
    const glm::ivec2 pixel = glm::min(glm::ivec2(px), masked.sizePx() - 1);
    return masked.hasRay.at(pixel.x, pixel.y) > 0;
}

bool isLitByAnother(const std::vector<Masked>& wall, size_t self, glm::dvec3 ray) {
    for (size_t i = 0; i < wall.size(); ++i) {
        if (i == self) continue;
        for (const glm::dvec2 px : wall[i].display->projection->project(ray))
            if (lights(wall[i], px, kSameBorderPx)) return true;
    }
    return false;
}

// Just outside of the display or in a hole of it, at a place that another display shows. There the mask has
// to fall to zero; where the wall itself ends it has not.
bool isEndWithinAnother(const std::vector<Masked>& wall, size_t self, glm::ivec2 pixel) {
    const Masked& masked = wall[self];
    const glm::ivec2 size = masked.sizePx();
    const auto isLit = [&](glm::dvec2 px) {
        const auto ray = masked.rayAt(px);
        return ray && isLitByAnother(wall, self, *ray);
    };
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
        return isLit(glm::clamp(glm::dvec2(pixel) + 0.5, glm::dvec2(0), glm::dvec2(size)));
    if (masked.hasRay.at(pixel.x, pixel.y) > 0) return false;
    for (int y = std::max(pixel.y - 1, 0); y <= std::min(pixel.y + 1, size.y - 1); ++y)
        for (int x = std::max(pixel.x - 1, 0); x <= std::min(pixel.x + 1, size.x - 1); ++x)
            if (masked.hasRay.at(x, y) > 0 && isLit({x + 0.5, y + 0.5})) return true;
    return false;
}

void measureDistances(std::vector<Masked>& wall, size_t self) {
    Grid& distances = wall[self].distancesPx;
    std::vector<uint8_t> isEnd(distances.values.size());
    parallelRanges(distances.sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < distances.sizePx.x; ++x)
                isEnd[distances.indexOf(x, y)] = isEndWithinAnother(wall, self, {x - 1, y - 1});
    });
    distances.values = distancesToMarked(isEnd, distances.sizePx);
    // Where the display ends nowhere within another one, any weight will do.
    if (std::isinf(distances.values.front()))
        std::ranges::fill(distances.values, glm::length(glm::vec2(distances.sizePx)));
}

// How much the display has to say at a position: the square lets masks begin and end with slope zero.
double weightAt(const Masked& masked, glm::dvec2 px) {
    // Ends lie half a pixel from the centres that stand for them.
    const double distancePx = std::max(masked.distancesPx.bilinear(px + 1.0) - 0.5, 0.0);
    return std::pow(distancePx * masked.pixelRad, 2);
}

// Where `other` shows the ray: the position of the largest weight.
std::optional<glm::dvec2> positionOn(const Masked& other, glm::dvec3 ray) {
    std::optional<glm::dvec2> best;
    for (const glm::dvec2 px : other.display->projection->project(ray))
        if (lights(other, px, 0) && (!best || weightAt(other, px) > weightAt(other, *best))) best = px;
    return best;
}

void findOverlaps(std::vector<Masked>& wall, size_t self) {
    Masked& masked = wall[self];
    forEachRow(masked, [&](int y) {
        for (int x = 0; x < masked.sizePx().x; ++x) {
            if (!(masked.hasRay.at(x, y) > 0)) continue;
            const glm::dvec3 ray = *masked.rayAt({x + 0.5, y + 0.5});
            for (size_t i = 0; i < wall.size(); ++i) {
                if (i == self) continue;
                if (const auto px = positionOn(wall[i], ray))
                    masked.overlaps[static_cast<size_t>(y)].push_back(
                        {x, static_cast<uint32_t>(i), glm::vec2(*px)});
            }
        }
    });
}

// For every pixel of a row that others show too: visit(x, the sum of what `valueAt` says of them).
void sumOthers(const std::vector<Masked>& wall, const std::vector<Overlap>& row,
               const std::function<double(const Masked&, glm::dvec2)>& valueAt,
               const std::function<void(int x, double sum)>& visit) {
    for (size_t i = 0; i < row.size();) {
        const int x = row[i].x;
        double sum = 0;
        for (; i < row.size() && row[i].x == x; ++i) sum += valueAt(wall[row[i].display], row[i].px);
        visit(x, sum);
    }
}

void beginMask(std::vector<Masked>& wall, size_t self) {
    Masked& masked = wall[self];
    forEachRow(masked, [&](int y) {
        const auto& row = masked.overlaps[static_cast<size_t>(y)];
        for (int x = 0; x < masked.sizePx().x; ++x) masked.mask.at(x, y) = masked.hasRay.at(x, y);
        sumOthers(wall, row, weightAt, [&](int x, double others) {
            const double own = weightAt(masked, {x + 0.5, y + 0.5});
            masked.mask.at(x, y) = static_cast<float>(own / (own + others));
        });
    });
}

double maskAt(const Masked& masked, glm::dvec2 px) { return masked.mask.bilinear(px); }

// The masks sum to one on a pixel's centre, but between the centres of its own pixels another display shows
// something else than the formula: most where borders of two displays cross. Dividing by the sum that is
// really shown takes that out.
void level(std::vector<Masked>& wall) {
    std::vector<Grid> levelled;
    levelled.reserve(wall.size());
    for (const Masked& masked : wall) levelled.push_back(masked.mask);
    for (size_t i = 0; i < wall.size(); ++i)
        forEachRow(wall[i], [&](int y) {
            sumOthers(wall, wall[i].overlaps[static_cast<size_t>(y)], maskAt, [&](int x, double others) {
                const double own = wall[i].mask.at(x, y);
                levelled[i].at(x, y) = static_cast<float>(own / (own + others));
            });
        });
    for (size_t i = 0; i < wall.size(); ++i) wall[i].mask = std::move(levelled[i]);
}

size_t withRay(const Masked& masked) {
    return static_cast<size_t>(std::ranges::count(masked.hasRay.values, 1.0f));
}

BlendSum checkSum(const std::vector<Masked>& wall) {
    BlendSum sum;
    size_t pixels = 0, off = 0;
    for (size_t i = 0; i < wall.size(); ++i)
        for (int y = 0; y < wall[i].sizePx().y; ++y)
            sumOthers(wall, wall[i].overlaps[static_cast<size_t>(y)], maskAt, [&](int x, double others) {
                const double deviation = std::abs(wall[i].mask.at(x, y) + others - 1);
                off += deviation > kVisible;
                if (deviation <= sum.largestDeviation) return;
                sum.largestDeviation = deviation;
                sum.display = i;
                sum.pixel = {x, y};
            });
    for (const Masked& masked : wall) pixels += withRay(masked);
    sum.shareOff = pixels > 0 ? static_cast<double>(off) / static_cast<double>(pixels) : 0;
    return sum;
}

double overlapShareOf(const Masked& masked) {
    size_t overlapped = 0;
    for (const auto& row : masked.overlaps)
        for (size_t i = 0; i < row.size(); ++i) overlapped += i == 0 || row[i].x != row[i - 1].x;
    return overlapped > 0 ? static_cast<double>(overlapped) / static_cast<double>(withRay(masked)) : 0;
}

}  // namespace

BlendMasks makeBlendMasks(const Wall& wall) {
    std::vector<Masked> displays(wall.displays.begin(), wall.displays.end());
    for (Masked& masked : displays) findRays(masked);
    for (size_t i = 0; i < displays.size(); ++i) measureDistances(displays, i);
    for (size_t i = 0; i < displays.size(); ++i) findOverlaps(displays, i);
    for (size_t i = 0; i < displays.size(); ++i) beginMask(displays, i);
    for (int round = 0; round < kLevellingRounds; ++round) level(displays);

    BlendMasks masks;
    for (Masked& masked : displays) {
        const double overlapShare = overlapShareOf(masked);
        for (float& value : masked.mask.values) value = std::round(value * kPng16Steps) / kPng16Steps;
        if (overlapShare == 0) std::ranges::fill(masked.mask.values, 1.0f);
        masks.displays.push_back({masked.mask.values, overlapShare});
    }
    masks.sum = checkSum(displays);
    return masks;
}

}  // namespace curvewall
