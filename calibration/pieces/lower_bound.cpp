#include "calibration/pieces/lower_bound.h"

#include "calibration/pieces/largest_cell.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace curvewall {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A rectangle of the display with one place in it that stands for all of it.
struct Part {
    glm::dvec2 fromPx{0}, toPx{0};
    int depth = 0;      // of cuts
    double weight = 0;  // of what has rays
    glm::dvec2 placePx{0};
    double heaviest = kInfinity;  // cell that has the place; infinite while none is known
    double doubt = kInfinity;     // about its share of the bound

    double share() const { return weight / heaviest; }
};

// Sums up 1 / A over the display, in parts that are cut where the sum depends on them most.
class Quadrature {
public:
    Quadrature(const Projection& projection, glm::ivec2 sizePx, const std::vector<HalfPlane>& outline,
               const PixelWeight& weight, double tolerancePx)
        : projection_(projection),
          sizePx_(sizePx),
          outline_(outline),
          weight_(weight),
          tolerancePx_(tolerancePx) {
        if (!outline_.empty()) parts_.push_back(partOf(glm::dvec2(0), glm::dvec2(sizePx), 0));
    }

    double sum();

    // True where a cell reaches over most of the display along an axis.
    bool hasCellAcross(int axis) const;

private:
    double total() const;
    double doubt() const;
    Part partOf(glm::dvec2 fromPx, glm::dvec2 toPx, int depth) const;
    void search(glm::dvec2 px);
    void takeInto(Part& part, const ConvexCell& cell) const;
    void cut(const Part& whole);

    const Projection& projection_;
    glm::dvec2 sizePx_;
    const std::vector<HalfPlane>& outline_;
    PixelWeight weight_;
    double tolerancePx_;
    std::vector<Part> parts_;
    std::vector<ConvexCell> cells_;  // all that were found
    int searches_ = 0;
};

double Quadrature::sum() {
    constexpr int kMostSearches = 160;
    constexpr double kGoodEnough = 0.01;  // of the sum
    while (!parts_.empty() && searches_ < kMostSearches && !(doubt() <= kGoodEnough * total())) {
        const auto worst = std::ranges::max_element(parts_, {}, &Part::doubt);
        const Part whole = *worst;
        parts_.erase(worst);
        cut(whole);
    }
    return total();
}

bool Quadrature::hasCellAcross(int axis) const {
    return std::ranges::any_of(cells_, [&](const ConvexCell& cell) {
        const auto along = [axis](glm::dvec2 corner) { return corner[axis]; };
        const auto [least, most] = std::ranges::minmax(cell.corners, {}, along);
        return most[axis] - least[axis] > 0.5 * sizePx_[axis];
    });
}

double Quadrature::total() const {
    double sum = 0;
    for (const Part& part : parts_) sum += part.share();
    return sum;
}

double Quadrature::doubt() const {
    double squares = 0;
    for (const Part& part : parts_) squares += part.doubt * part.doubt;
    return std::sqrt(squares);
}

Part Quadrature::partOf(glm::dvec2 fromPx, glm::dvec2 toPx, int depth) const {
    constexpr int kLattice = 16;
    const glm::dvec2 step = (toPx - fromPx) / double(kLattice);
    std::vector<glm::dvec2> shown;
    glm::dvec2 middle(0);
    for (int j = 0; j < kLattice; ++j) {
        for (int i = 0; i < kLattice; ++i) {
            const glm::dvec2 px = fromPx + step * (glm::dvec2(i, j) + 0.5);
            if (!projection_.unproject(px)) continue;
            shown.push_back(px);
            middle += px;
        }
    }
    Part part{fromPx, toPx, depth};
    for (glm::dvec2 px : shown) part.weight += step.x * step.y * weight_.at(px);
    if (shown.empty()) return part;
    part.placePx = middle / static_cast<double>(shown.size());
    if (!projection_.unproject(part.placePx))
        part.placePx = *std::ranges::min_element(
            shown, {}, [&](glm::dvec2 px) { return glm::distance(px, part.placePx); });
    return part;
}

// A cell that was found for one place is one for all others in it.
void Quadrature::search(glm::dvec2 px) {
    for (glm::dvec2 stretch : {glm::dvec2(1, 0), glm::dvec2(3, 0), glm::dvec2(0, 3)}) {
        const auto cell = largestCell(projection_, outline_, weight_, px, tolerancePx_, stretch);
        if (!cell) continue;
        cells_.push_back(*cell);
        for (Part& part : parts_) takeInto(part, *cell);
    }
    ++searches_;
}

// Pieces are not smaller than a pixel.
void Quadrature::takeInto(Part& part, const ConvexCell& cell) const {
    const double weight = std::max(weight_.at(part.placePx), cell.weight);
    if ((weight > part.heaviest || part.heaviest == kInfinity) && cell.has(part.placePx))
        part.heaviest = weight;
}

void Quadrature::cut(const Part& whole) {
    constexpr int kFirstCuts = 2;
    const glm::dvec2 half = 0.5 * (whole.toPx - whole.fromPx);
    const size_t before = parts_.size();
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 from = whole.fromPx + half * glm::dvec2(i % 2, i / 2);
        Part part = partOf(from, from + half, whole.depth + 1);
        if (part.weight == 0) continue;
        for (const ConvexCell& cell : cells_) takeInto(part, cell);
        parts_.push_back(part);
        search(part.placePx);
    }
    const std::span<Part> fresh(parts_.begin() + static_cast<std::ptrdiff_t>(before), parts_.end());
    double share = 0;
    for (const Part& part : fresh) share += part.share();
    for (Part& part : fresh)
        if (part.depth >= kFirstCuts)
            part.doubt = share > 0 ? std::abs(share - whole.share()) * part.share() / share : 0;
}

// Whether one homography does for all of the display.
bool isOnePiece(const Projection& projection, glm::ivec2 sizePx, const std::vector<HalfPlane>& outline,
                double tolerancePx) {
    constexpr int kLattice = 64;
    const glm::dvec2 size(sizePx);
    const auto cell = largestCell(projection, outline, {}, 0.5 * size, tolerancePx, {1, 0});
    if (!cell) return false;
    for (int j = 0; j <= kLattice; ++j)
        for (int i = 0; i <= kLattice; ++i)
            if (errorPx(projection, cell->screenFromRay, size * glm::dvec2(i, j) / double(kLattice)) >
                tolerancePx)
                return false;
    return true;
}

}  // namespace

// Any weight of the display's pixels gives a bound. Where cells end at the display's sides, one that grows
// towards them gives a better one: a cell that bulges in between, as no two neighbours can, gains little.
double lowerBoundOfPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx) {
    constexpr int kSteepest = 8;
    const std::vector<HalfPlane> outline = displayOutline(projection, sizePx);
    if (outline.empty() || isOnePiece(projection, sizePx, outline, tolerancePx)) return 1;
    const auto quadrature = [&](const PixelWeight& weight) {
        return Quadrature(projection, sizePx, outline, weight, tolerancePx);
    };
    Quadrature evenly = quadrature({});
    double bound = std::max(1.0, evenly.sum());
    for (int axis = 0; axis < 2; ++axis) {
        if (!evenly.hasCellAcross(axis)) continue;
        const double halfPx = 0.5 * sizePx[axis];
        glm::dvec2 direction(0);
        direction[axis] = 1;
        bound = std::max(bound, quadrature({direction, halfPx, halfPx, kSteepest}).sum());
    }
    return bound;
}

}  // namespace curvewall
