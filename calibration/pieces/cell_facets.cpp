#include "calibration/pieces/cell_facets.h"

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace curvewall {
namespace {

constexpr int kLattice = 5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The surface as the cell's pixels show it, to first order: m(s) = m0 + J (s - s0).
struct FlatModel {
    glm::dvec2 s0{0};
    glm::dvec3 m0{0};
    glm::dmat2x3 slope{0};

    glm::dvec3 at(glm::dvec2 s) const { return m0 + slope * (s - s0); }
};

// A slope for what pixels in one line leave open: square to what is known, as steep, turned as displays are
// (x right and y down give a positive determinant).
glm::dmat2x3 completed(glm::dvec3 m, std::optional<glm::dvec3> alongX, std::optional<glm::dvec3> alongY,
                       double unknownStep) {
    const glm::dvec3 ray = glm::normalize(m);
    if (!alongX && !alongY) {
        const glm::dvec3 aside = std::abs(ray.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        alongX = glm::normalize(glm::cross(ray, aside)) * unknownStep * glm::length(m);
    }
    if (!alongY) alongY = glm::cross(ray, *alongX);
    if (!alongX) alongX = glm::cross(*alongY, ray);
    return {*alongX, *alongY};
}

FlatModel flatModelOf(const PixelRays& rays, const std::vector<SeenPixel>& pixels) {
    FlatModel model;
    for (const auto& [px, ray] : pixels) {
        model.s0 += centreOf(px) / static_cast<double>(pixels.size());
        model.m0 += ray / static_cast<double>(pixels.size());
    }
    glm::dmat2 spread(0);
    glm::dmat2x3 common(0);
    for (const auto& [px, ray] : pixels) {
        const glm::dvec2 ds = centreOf(px) - model.s0;
        spread += glm::outerProduct(ds, ds);
        common += glm::outerProduct(ray - model.m0, ds);
    }
    const double largest = std::max(spread[0][0], spread[1][1]);
    if (glm::determinant(spread) > 1e-6 * largest * largest) {
        model.slope = common * glm::inverse(spread);
        return model;
    }
    // All in one line, or a single one. Along the line the slope is known.
    std::optional<glm::dvec3> alongX, alongY;
    if (largest > 0) {
        const bool isRow = spread[0][0] >= spread[1][1];
        (isRow ? alongX : alongY) = isRow ? common[0] / spread[0][0] : common[1] / spread[1][1];
    }
    const double step = 1.0 / std::max(rays.sizePx().x, rays.sizePx().y);
    model.slope = completed(model.m0, alongX, alongY, step);
    return model;
}

bool hasHoles(const Cell& cell, const std::vector<SeenPixel>& pixels) {
    const glm::ivec2 counts = glm::min(cell.sizePx(), glm::ivec2(kLattice));
    return pixels.size() < static_cast<size_t>(counts.x) * static_cast<size_t>(counts.y);
}

bool isThin(const std::vector<SeenPixel>& pixels) {
    constexpr int kFewPx = 4;
    glm::ivec2 least = pixels.front().px, most = least;
    for (const SeenPixel& pixel : pixels) {
        least = glm::min(least, pixel.px);
        most = glm::max(most, pixel.px);
    }
    return std::min(most.x - least.x, most.y - least.y) + 1 < kFewPx;
}

// Where a display ends within a cell, the few pixels that it has there do not say how its surface goes on to
// the cell's corners; those beside the cell do.
std::vector<SeenPixel> pixelsAround(const PixelRays& rays, const Cell& cell) {
    const glm::ivec2 size = cell.sizePx();
    const Cell around{glm::max(cell.fromPx - size, glm::ivec2(0)), glm::min(cell.toPx + size, rays.sizePx())};
    return latticePixels(rays, around, 3 * kLattice);
}

double facetDeterminant(const std::array<glm::dvec3, 4>& m, const std::array<uint32_t, 3>& facet) {
    return glm::determinant(glm::dmat3(m[facet[0]], m[facet[1]], m[facet[2]]));
}

// The plane under the cell's pixels whose homography takes their rays nearest to their places, by linear
// least squares. Rays are written in the flat model's own axes and places as fractions of the cell, so the
// answer is the identity but for what the surface bends: h1 . c = u h3 . c, h2 . c = v h3 . c, h3 = (1, a,
// b). Gives the points of the plane at the cell's corners.
//
// The pixels around the cell have a small say: they decide what its own leave open, where a display ends
// within the cell or the cell is thin.
std::array<glm::dvec3, 4> bestPlane(const PixelRays& rays, const Cell& cell,
                                    const std::vector<SeenPixel>& own, const std::vector<SeenPixel>& around) {
    constexpr double kSayOfOthers = 1e-3;
    const FlatModel model = flatModelOf(rays, around.empty() ? own : around);
    const glm::dvec2 half = 0.5 * glm::dvec2(cell.sizePx());
    const glm::dmat3 axes(model.m0, half.x * model.slope[0], half.y * model.slope[1]);
    const glm::dmat3 fromRay = glm::inverse(axes);
    const auto place = [&](glm::dvec2 px) { return (px - model.s0) / half; };

    // A pixel gives the rows (c, 0, -u c.y, -u c.z) and (0, c, -v c.y, -v c.z), so the normal equations are
    // made of the moments of c, with c.x = 1.
    Eigen::Matrix3d plain = Eigen::Matrix3d::Zero(), byU = plain, byV = plain, bySquares = plain;
    const auto add = [&](const SeenPixel& pixel, double weight) {
        const glm::dvec3 seen = fromRay * pixel.ray;
        const Eigen::Vector3d c(1, seen.y / seen.x, seen.z / seen.x);
        const glm::dvec2 uv = place(centreOf(pixel.px));
        const Eigen::Matrix3d moment = weight * c * c.transpose();
        plain += moment;
        byU += uv.x * moment;
        byV += uv.y * moment;
        bySquares += glm::dot(uv, uv) * moment;
    };
    for (const SeenPixel& pixel : own) add(pixel, 1);
    for (const SeenPixel& pixel : around) add(pixel, kSayOfOthers);

    Eigen::Matrix<double, 8, 8> normal = Eigen::Matrix<double, 8, 8>::Zero();
    normal.block<3, 3>(0, 0) = normal.block<3, 3>(3, 3) = plain;
    normal.block<3, 2>(0, 6) = -byU.rightCols<2>();
    normal.block<3, 2>(3, 6) = -byV.rightCols<2>();
    normal.block<2, 6>(6, 0) = normal.block<6, 2>(0, 6).transpose();
    normal.block<2, 2>(6, 6) = bySquares.bottomRightCorner<2, 2>();
    Eigen::Matrix<double, 8, 1> right, flat;
    right << byU.col(0), byV.col(0), -bySquares.col(0).tail<2>();
    // And a trace of "it does not bend", where they leave it open too.
    const double trace = 1e-6 * static_cast<double>(own.size());
    flat << 0, 1, 0, 0, 0, 1, 0, 0;
    normal.diagonal().array() += trace;
    right += trace * flat;
    const Eigen::Matrix<double, 8, 1> h = normal.ldlt().solve(right);
    const glm::dmat3 fromC(h[0], h[3], 1, h[1], h[4], h[6], h[2], h[5], h[7]);
    const glm::dmat3 fromPlace = axes * glm::inverse(fromC);
    std::array<glm::dvec3, 4> m{};
    for (size_t i = 0; i < 4; ++i) m[i] = fromPlace * glm::dvec3(place(cornersOf(cell)[i]), 1);
    return m;
}

// Near a pole or a rim, where a display's scale has no bound, a plane can be right at every pixel's centre
// and span half the space between them. Such pieces would touch everything.
bool isWiderThanSeen(const std::vector<SeenPixel>& pixels, const std::array<glm::dvec3, 4>& corners) {
    constexpr double kMostTimes = 4;
    constexpr double kRounding = 1e-12;  // of one ray seen by all
    glm::dvec3 mean(0);
    for (const SeenPixel& pixel : pixels) mean += glm::normalize(pixel.ray);
    mean = glm::normalize(mean);
    double seen = 0, spanned = 0;
    for (const SeenPixel& pixel : pixels)
        seen = std::max(seen, glm::distance(glm::normalize(pixel.ray), mean));
    for (const glm::dvec3& corner : corners)
        spanned = std::max(spanned, glm::distance(glm::normalize(corner), mean));
    return seen > kRounding && !(spanned <= kMostTimes * seen);
}

}  // namespace

std::array<glm::ivec2, 4> cornersOf(const Cell& cell) {
    return {cell.fromPx, {cell.toPx.x, cell.fromPx.y}, cell.toPx, {cell.fromPx.x, cell.toPx.y}};
}

const FacetCorners& facetCorners(bool fallingDiagonal) {
    static constexpr FacetCorners kFalling{{{0, 1, 2}, {0, 2, 3}}};
    static constexpr FacetCorners kRising{{{0, 1, 3}, {1, 2, 3}}};
    return fallingDiagonal ? kFalling : kRising;
}

size_t facetAt(const Cell& cell, bool fallingDiagonal, glm::ivec2 px) {
    const glm::dvec2 at = (centreOf(px) - glm::dvec2(cell.fromPx)) / glm::dvec2(cell.sizePx());
    return fallingDiagonal ? at.y > at.x : at.x + at.y > 1;
}

std::vector<SeenPixel> latticePixels(const PixelRays& rays, const Cell& cell, int perAxis) {
    const glm::ivec2 size = cell.sizePx();
    const glm::ivec2 counts = glm::min(size, glm::ivec2(perAxis));
    const auto position = [&](int i, int axis) {
        return cell.fromPx[axis] + (counts[axis] > 1 ? i * (size[axis] - 1) / (counts[axis] - 1) : 0);
    };
    std::vector<SeenPixel> pixels;
    pixels.reserve(static_cast<size_t>(counts.x) * static_cast<size_t>(counts.y));
    const auto add = [&](glm::ivec2 px) {
        if (const glm::dvec3 ray = rays.at(px); PixelRays::isRay(ray)) pixels.push_back({px, ray});
    };
    for (int j = 0; j < counts.y; ++j)
        for (int i = 0; i < counts.x; ++i) add({position(i, 0), position(j, 1)});
    for (int y = cell.fromPx.y; y < cell.toPx.y && pixels.empty(); ++y)
        for (int x = cell.fromPx.x; x < cell.toPx.x && pixels.empty(); ++x) add({x, y});
    return pixels;
}

double facetErrorPx(const PixelRays& rays, const Cell& cell, const std::array<glm::dvec3, 4>& m, bool falling,
                    const std::vector<SeenPixel>& pixels) {
    const std::array<glm::ivec2, 4> corners = cornersOf(cell);
    std::array<glm::dmat3, 2> h;
    for (size_t k = 0; k < 2; ++k) {
        const auto& facet = facetCorners(falling)[k];
        const double det = facetDeterminant(m, facet);
        if (!(std::abs(det) > 0 && std::isfinite(det))) return kInfinity;
        const auto vertex = [&](size_t i) { return PieceVertex{m[facet[i]], corners[facet[i]]}; };
        h[k] = homographyThrough(vertex(0), vertex(1), vertex(2));
    }
    const bool thin = isThin(pixels);
    double worst = 0;
    for (const SeenPixel& pixel : pixels)
        worst = std::max(worst, facetErrorPx(rays, pixel, h[facetAt(cell, falling, pixel.px)], thin));
    return worst;
}

CellFacets facetsOf(const PixelRays& rays, const Cell& cell) {
    CellFacets facets;
    const std::vector<SeenPixel> pixels = latticePixels(rays, cell, kLattice);
    facets.isEmpty = pixels.empty();
    if (facets.isEmpty) return facets;

    facets.pixelCount = static_cast<int>(pixels.size());
    facets.isThin = isThin(pixels);
    const auto fit = [&](const std::vector<SeenPixel>& around) {
        facets.corners = bestPlane(rays, cell, pixels, around);
        facets.errorPx = isWiderThanSeen(around.empty() ? pixels : around, facets.corners)
                             ? kInfinity
                             : facetErrorPx(rays, cell, facets.corners, true, pixels);
    };
    if (!hasHoles(cell, pixels) && std::min(cell.sizePx().x, cell.sizePx().y) > 1) {
        fit({});
        return facets;
    }
    fit(pixelsAround(rays, cell));
    return facets;
}

CellFacets facetsOfLonePixel(const PixelRays& rays, const Cell& cell) {
    return {bestPlane(rays, cell, {{cell.fromPx, rays.at(cell.fromPx)}}, {}), 0, 1, false, true};
}

double facetErrorPx(const PixelRays& rays, const SeenPixel& pixel, const glm::dmat3& screenFromRay,
                    bool isThin) {
    constexpr double kExact = 1e-6;  // then the ray that is shown is the pixel's
    const glm::dvec2 centre = centreOf(pixel.px);
    const glm::dvec3 seen = screenFromRay * pixel.ray;
    if (!(seen.z > 0)) return kInfinity;
    const double landsPx = glm::distance(glm::dvec2(seen) / seen.z, centre);
    if (!isThin || landsPx <= kExact) return landsPx;
    const auto offset = rays.offsetPx(pixel.px, glm::inverse(screenFromRay) * glm::dvec3(centre, 1));
    return offset ? std::max(landsPx, glm::length(*offset)) : landsPx;
}

Cut bestCut(const PixelRays& rays, const Cell& cell) {
    // The error falls with the square of a cell's size, so its root says how many cells are still to come.
    constexpr double kLargestErrorPx = 1e4;
    const auto cellsToCome = [&](const CellFacets& half) {
        return std::sqrt(std::min(half.errorPx, kLargestErrorPx));
    };
    Cut best;
    double fewest = kInfinity;
    const glm::ivec2 size = cell.sizePx();
    const int longer = size.x >= size.y ? 0 : 1;
    for (int axis : {longer, 1 - longer}) {
        if (size[axis] < 2) continue;
        const auto [first, second] = halvesOf(cell, axis);
        const Cut cut{axis, {facetsOf(rays, first), facetsOf(rays, second)}};
        const double cells = cellsToCome(cut.halves[0]) + cellsToCome(cut.halves[1]);
        if (cells < fewest) {
            best = cut;
            fewest = cells;
        }
    }
    return best;
}

}  // namespace curvewall
