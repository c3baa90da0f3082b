#include "calibration/pieces/radial_fit.h"

#include "calibration/pieces/fit_stop.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/radial_map.h"
#include "calibration/pieces/radial_profile.h"

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>

namespace curvewall {
namespace {

constexpr double kAside = 0.02;  // of the tolerance: how far a display may be from round
// Least squares first; then the largest error is sought, closely in the end.
constexpr int kPlainSteps = 10, kMinimaxSteps = 6, kCloseSteps = 4;
constexpr int kLawsonSteps = 6, kCloseLawsonSteps = 10;
constexpr int kSamplesOutward = 2, kCloseSamplesOutward = 5;
constexpr double kLeastPart = 1e-6;  // weights stay above this part of the tolerance

struct HeightSample {
    glm::dvec2 px;
    double height;
    double pxPerHeight;
};

// What a facet has of the display.
struct FacetCell {
    std::vector<uint32_t> corners;
    std::vector<HeightSample> samples;
    double errorPx = 0;
};

// Where the display ends on the way from a place that it shows.
glm::dvec2 lastShown(const RadialMap& map, glm::dvec2 on, glm::dvec2 off) {
    for (int halving = 0; halving < 20; ++halving) {
        const glm::dvec2 middle = 0.5 * (on + off);
        (map.height(middle) ? on : off) = middle;
    }
    return on;
}

// Facets and the cells in which they are the lowest.
class FacetedHeight {
public:
    FacetedHeight(const RadialMap& map, std::vector<RadialFacet> facets)
        : map_(map), facets_(std::move(facets)) {
        rebuild(1);
    }

    const RadialMap& map() const { return map_; }
    const std::vector<RadialFacet>& facets() const { return facets_; }
    const std::vector<FacetCell>& cells() const { return cells_; }
    const std::vector<glm::dvec2>& cornersPx() const { return envelope_.corners; }
    double errorPx() const {
        return cells_.empty() ? 0 : std::ranges::max(cells_, {}, &FacetCell::errorPx).errorPx;
    }

    // Lloyd's step: every facet is fitted to its cell, then the cells follow the facets.
    void relax(double tolerancePx, int lawsonSteps, int samplesOutward) {
        for (size_t k = 0; k < facets_.size(); ++k)
            fitToCell(facets_[k], cells_[k], tolerancePx, lawsonSteps);
        rebuild(samplesOutward);
    }

private:
    void rebuild(int samplesOutward) {
        std::vector<HeightPlane> planes;
        for (const RadialFacet& facet : facets_) planes.push_back(facet.plane);
        envelope_ = lowestPlanes(planes, map_.sizePx());
        cells_.clear();
        std::vector<RadialFacet> used;
        for (size_t k = 0; k < facets_.size(); ++k) {
            if (envelope_.cells[k].empty()) continue;
            FacetCell cell = cellOf(facets_[k], std::move(envelope_.cells[k]), samplesOutward);
            if (cell.samples.empty()) continue;
            used.push_back(facets_[k]);
            cells_.push_back(std::move(cell));
        }
        facets_ = std::move(used);
        envelope_.cells.clear();
    }

    // Samples at the site, around what the cell shows, and on the way there.
    FacetCell cellOf(const RadialFacet& facet, std::vector<uint32_t> corners, int samplesOutward) const {
        FacetCell cell{std::move(corners), {}, 0};
        const glm::dmat3 points = map_.pointsOf(facet.plane), screenFromRay = glm::inverse(points);
        const glm::dvec3 axisOnScreen = screenFromRay * map_.axis();
        const auto addShown = [&](glm::dvec2 px) {
            const auto height = map_.height(px);
            if (!height) return;
            const glm::dvec3 landing = screenFromRay * map_.pointAt(px, *height);
            const double error = landing.z > 0 ? glm::distance(glm::dvec2(landing) / landing.z, px)
                                               : std::numeric_limits<double>::infinity();
            cell.errorPx = std::max(cell.errorPx, error);
            cell.samples.push_back(
                {px, *height, glm::length(glm::dvec2(axisOnScreen) - px * axisOnScreen.z)});
        };
        addShown(facet.sitePx);
        for (glm::dvec2 outermost : outlineOf(facet.sitePx, cell.corners))
            for (int part = 1; part <= samplesOutward; ++part)
                addShown(glm::mix(facet.sitePx, outermost, double(part) / samplesOutward));
        return cell;
    }

    // Around what a cell shows: its corners, the middles between, and where the display ends.
    std::vector<glm::dvec2> outlineOf(glm::dvec2 sitePx, const std::vector<uint32_t>& corners) const {
        std::vector<glm::dvec2> outline, rim;
        for (size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 from = envelope_.corners[corners[i]];
            const glm::dvec2 to = envelope_.corners[corners[(i + 1) % corners.size()]];
            const bool fromShown = map_.height(from).has_value(), toShown = map_.height(to).has_value();
            if (fromShown) outline.push_back(from);
            if (const glm::dvec2 middle = 0.5 * (from + to); map_.height(middle)) outline.push_back(middle);
            if (fromShown != toShown)
                rim.push_back(lastShown(map_, fromShown ? from : to, fromShown ? to : from));
            if (!fromShown) rim.push_back(lastShown(map_, sitePx, from));
        }
        addBetween(sitePx, rim);
        outline.insert(outline.end(), rim.begin(), rim.end());
        return outline;
    }

    // Corners far outside the display leave wide angles between the places where it ends.
    void addBetween(glm::dvec2 sitePx, std::vector<glm::dvec2>& rim) const {
        constexpr int kParts = 4;
        const size_t count = rim.size();
        if (count < 2) return;
        glm::dvec2 outward(0);
        for (glm::dvec2 px : rim) outward += px - sitePx;
        const auto angleOf = [&](glm::dvec2 px) {
            const glm::dvec2 off = px - sitePx;
            return std::atan2(outward.x * off.y - outward.y * off.x, glm::dot(outward, off));
        };
        std::ranges::sort(rim, {}, angleOf);
        for (size_t i = 0; i + 1 < count; ++i) {
            for (int part = 1; part < kParts; ++part) {
                const glm::dvec2 chord = glm::mix(rim[i], rim[i + 1], double(part) / kParts);
                rim.push_back(lastShown(map_, chord, chord + outward));
            }
        }
    }

    // The plane whose largest error over the samples is smallest: least squares, made uneven by Lawson's
    // weights, and then the height half way between the two ends of the error.
    static void fitToCell(RadialFacet& facet, const FacetCell& cell, double tolerancePx, int lawsonSteps) {
        std::vector<double> weights;
        for (const HeightSample& sample : cell.samples)
            weights.push_back(std::max(sample.pxPerHeight * sample.pxPerHeight, 1e-12));
        glm::dvec3 best(0);
        for (int step = 0; step <= lawsonSteps; ++step) {
            Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
            Eigen::Vector3d right = Eigen::Vector3d::Zero();
            for (size_t i = 0; i < weights.size(); ++i) {
                const glm::dvec2 off = cell.samples[i].px - facet.sitePx;
                const Eigen::Vector3d row(1, off.x, off.y);
                normal += weights[i] * row * row.transpose();
                right += weights[i] * cell.samples[i].height * row;
            }
            const Eigen::LLT<Eigen::Matrix3d> factors(normal);
            if (factors.info() != Eigen::Success) return;
            const Eigen::Vector3d plane = factors.solve(right);
            if (!plane.allFinite()) return;
            best = {plane[0], plane[1], plane[2]};
            double sum = 0;
            for (size_t i = 0; i < weights.size(); ++i) {
                const double error = errorOf(cell.samples[i], facet.sitePx, best);
                sum += weights[i] *= std::abs(error) + kLeastPart * tolerancePx;
            }
            for (double& weight : weights) weight /= sum;
        }
        best[0] += shiftToEvenError(facet.sitePx, cell.samples, best);
        const glm::dvec2 slope(best[1], best[2]);
        facet.plane = {best[0] - glm::dot(slope, facet.sitePx), slope};
        glm::dvec2 middle(0);
        for (const HeightSample& sample : cell.samples) middle += sample.px / double(cell.samples.size());
        facet.sitePx = middle;
    }

    // In px, positive where the plane (height at the site, slope) is above the display.
    static double errorOf(const HeightSample& sample, glm::dvec2 sitePx, glm::dvec3 plane) {
        const glm::dvec2 off = sample.px - sitePx;
        return (plane[0] + plane[1] * off.x + plane[2] * off.y - sample.height) * sample.pxPerHeight;
    }

    // The largest error is a convex function of the shift.
    static double shiftToEvenError(glm::dvec2 sitePx, std::span<const HeightSample> samples,
                                   glm::dvec3 plane) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        std::vector<glm::dvec2> errors;  // without a shift, and what a unit of shift adds
        for (const HeightSample& sample : samples) {
            const glm::dvec2 error(errorOf(sample, sitePx, plane), sample.pxPerHeight);
            errors.push_back(error);
            if (!(error.y > 0)) continue;
            low = std::min(low, -error.x / error.y);
            high = std::max(high, -error.x / error.y);
        }
        const auto largest = [&](double shift) {
            double most = 0;
            for (glm::dvec2 error : errors) most = std::max(most, std::abs(error.x + shift * error.y));
            return most;
        };
        for (int step = 0; step < 20; ++step) {
            const double a = low + 0.4 * (high - low), b = low + 0.6 * (high - low);
            if (largest(a) < largest(b))
                high = b;
            else
                low = a;
        }
        return std::isfinite(low + high) ? 0.5 * (low + high) : 0;
    }

    RadialMap map_;
    std::vector<RadialFacet> facets_;
    PlaneEnvelope envelope_;  // its cells are in cells_
    std::vector<FacetCell> cells_;
};

// Where the display ends within cells, their edges end a little outside of it, or facets would reach over the
// hole. An edge is cut once for both of its cells, so that they still meet corner to corner.
class RimCut {
public:
    explicit RimCut(const FacetedHeight& faceted) : faceted_(faceted) {
        for (glm::dvec2 px : faceted.cornersPx()) shown_.push_back(faceted.map().height(px).has_value());
        for (const FacetCell& cell : faceted.cells()) {
            const std::vector<Edge> edges = rimEdges(cell.corners);
            if (edges.size() != 2)
                for (const Edge& edge : edges) uncut_.insert(edge);
        }
        while (std::ranges::count_if(faceted.cells(), [&](const FacetCell& cell) { return widen(cell); }) >
               0) {
        }
    }

    // The corners of a cell, with those beyond the rim replaced by where its edges are cut.
    std::vector<glm::dvec2> cornersOf(const FacetCell& cell) const {
        const std::vector<uint32_t>& corners = cell.corners;
        std::vector<glm::dvec2> px;
        const bool isCut = rimEdges(corners).size() == 2;
        for (size_t i = 0; i < corners.size(); ++i) {
            const uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
            if (!isCut || shown_[from]) px.push_back(faceted_.cornersPx()[from]);
            if (isCut && shown_[from] != shown_[to]) px.push_back(cutOf(edgeOf(from, to)));
        }
        return px;
    }

private:
    static constexpr double kFirstMarginPx = 1, kMostMarginPx = 64;
    using Edge = std::pair<uint32_t, uint32_t>;  // from a corner that is shown to one that is not

    Edge edgeOf(uint32_t a, uint32_t b) const { return shown_[a] ? Edge(a, b) : Edge(b, a); }

    std::vector<Edge> rimEdges(const std::vector<uint32_t>& corners) const {
        std::vector<Edge> edges;
        for (size_t i = 0; i < corners.size(); ++i) {
            const uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
            if (shown_[from] != shown_[to]) edges.push_back(edgeOf(from, to));
        }
        return edges;
    }

    glm::dvec2 cutOf(const Edge& edge) const {
        const glm::dvec2 in = faceted_.cornersPx()[edge.first], out = faceted_.cornersPx()[edge.second];
        const auto margin = marginsPx_.find(edge);
        const double marginPx = margin == marginsPx_.end() ? kFirstMarginPx : margin->second;
        const glm::dvec2 rim = lastShown(faceted_.map(), in, out);
        if (uncut_.contains(edge) || glm::distance(rim, out) <= marginPx) return out;
        return rim + glm::normalize(out - in) * marginPx;
    }

    // False where the line between a cell's two cuts leaves out nothing that is shown.
    bool widen(const FacetCell& cell) {
        const std::vector<Edge> edges = rimEdges(cell.corners);
        if (edges.size() != 2 || showsNothing(leftOut(cell.corners))) return false;
        bool isWider = false;
        for (const Edge& edge : edges) {
            double& marginPx = marginsPx_.emplace(edge, kFirstMarginPx).first->second;
            if (uncut_.contains(edge)) continue;
            isWider = true;
            if ((marginPx *= 2) > kMostMarginPx) uncut_.insert(edge);
        }
        return isWider;
    }

    std::vector<glm::dvec2> leftOut(const std::vector<uint32_t>& corners) const {
        std::vector<glm::dvec2> px;
        for (size_t i = 0; i < corners.size(); ++i) {
            const uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
            if (!shown_[from]) px.push_back(faceted_.cornersPx()[from]);
            if (shown_[from] != shown_[to]) px.push_back(cutOf(edgeOf(from, to)));
        }
        return px;
    }

    // Looks closely along the edges, where the display comes nearest.
    bool showsNothing(const std::vector<glm::dvec2>& polygon) const {
        constexpr int kAlongEdge = 128, kInwards = 4;
        glm::dvec2 middle(0);
        for (glm::dvec2 px : polygon) middle += px / double(polygon.size());
        for (size_t i = 0; i < polygon.size(); ++i) {
            for (int k = 0; k < kAlongEdge; ++k) {
                const glm::dvec2 onEdge =
                    glm::mix(polygon[i], polygon[(i + 1) % polygon.size()], (k + 0.5) / kAlongEdge);
                for (int inwards = 0; inwards < (k % 16 == 0 ? kInwards : 1); ++inwards)
                    if (faceted_.map().height(glm::mix(onEdge, middle, double(inwards) / kInwards)))
                        return false;
            }
        }
        return true;
    }

    const FacetedHeight& faceted_;
    std::vector<bool> shown_;  // of every corner
    std::map<Edge, double> marginsPx_;
    std::set<Edge> uncut_;
};

// Pieces that a facet of so many edges becomes.
size_t partCount(size_t edges) { return std::max<size_t>(1, (edges - 3) / (kMostPieceEdges - 2) + 1); }

PieceMesh meshOf(const FacetedHeight& faceted) {
    PieceMesh mesh{faceted.map().sizePx(), {}, {}};
    const RimCut rim(faceted);
    PlacesPx places;
    for (size_t k = 0; k < faceted.cells().size(); ++k) {
        const HeightPlane& plane = faceted.facets()[k].plane;
        std::vector<uint32_t> around;
        for (glm::dvec2 px : rim.cornersOf(faceted.cells()[k])) {
            around.push_back(places.numberOf(px));
            if (around.back() == mesh.vertices.size())
                mesh.vertices.push_back({faceted.map().pointAt(px, plane.at(px)), px});
        }
        // Parts of one facet, each of no more edges than a piece may have.
        for (size_t from = 1; from + 1 < around.size(); from += kMostPieceEdges - 2) {
            Piece piece;
            piece.vertices[piece.vertexCount++] = around[0];
            for (size_t i = from; i < std::min<size_t>(around.size(), from + kMostPieceEdges - 1); ++i)
                piece.vertices[piece.vertexCount++] = around[i];
            piece.screenFromRay = glm::inverse(faceted.map().pointsOf(plane));
            mesh.pieces.push_back(piece);
        }
    }
    double distance = 0;
    for (const PieceVertex& vertex : mesh.vertices)
        distance += glm::length(vertex.m) / double(mesh.vertices.size());
    for (PieceVertex& vertex : mesh.vertices) vertex.m /= distance;
    for (Piece& piece : mesh.pieces) piece.screenFromRay *= distance;
    return mesh;
}

// Of the facets that meet the tolerance those with the fewest pieces, among rings of the rows that a covering
// needs and a row less or more; the error is about inverse to the density around.
class RingSearch {
public:
    RingSearch(const RadialMap& map, const RadialProfile& profile, double tolerancePx,
               const std::stop_token& stop)
        : map_(map), profile_(profile), tolerancePx_(tolerancePx), stop_(stop) {}

    std::optional<FacetedHeight> fewest() {
        constexpr double kUsualDensity = 1.22;
        const double rows = profile_.rowsFor(tolerancePx_ / kUsualDensity);
        searchAround(static_cast<int>(rows) + 1);
        searchAround(static_cast<int>(rows));
        for (int more = 2; !best_ && more < kMostMore; ++more) searchAround(static_cast<int>(rows) + more);
        return std::move(best_);
    }

private:
    static constexpr double kHopeless = 1.1;  // what close steps do not mend, times the tolerance
    static constexpr int kMostTries = 3, kMostMore = 8;

    void searchAround(int rows) {
        constexpr double kFirst = 1.2, kStep = 1.015, kMostStep = 1.3;
        double density = kFirst, fails = 0, passes = std::numeric_limits<double>::infinity();
        for (int i = 0; i < kMostTries; ++i) {
            FacetedHeight faceted = relaxed(rows, density);
            const double ratio = std::clamp(faceted.errorPx() / tolerancePx_, 1 / kMostStep, kMostStep);
            const bool isFewer = !best_ || pieceCount(faceted) < pieceCount(*best_);
            if (ratio <= 1) {
                passes = density;
                density = std::min(density * ratio, density / kStep);
                if (isFewer) best_ = std::move(faceted);
            } else {
                fails = density;
                density = std::max(density * ratio, density * kStep);
                if (!isFewer) return;
            }
            if (density <= fails || density >= passes) return;
        }
    }

    FacetedHeight relaxed(int rows, double density) const {
        FacetedHeight faceted(map_, profile_.rings(tolerancePx_, rows, density));
        const auto relax = [&](int steps, int lawsonSteps, int samplesOutward) {
            for (int step = 0; step < steps; ++step) {
                throwIfStopped(stop_);
                faceted.relax(tolerancePx_, lawsonSteps, samplesOutward);
            }
        };
        relax(kPlainSteps, 0, 1);
        relax(kMinimaxSteps, kLawsonSteps, kSamplesOutward);
        if (faceted.errorPx() > kHopeless * tolerancePx_) return faceted;
        relax(kCloseSteps, kCloseLawsonSteps, kCloseSamplesOutward);
        return faceted;
    }

    static size_t pieceCount(const FacetedHeight& faceted) {
        size_t count = 0;
        for (const FacetCell& cell : faceted.cells()) count += partCount(cell.corners.size());
        return count;
    }

    const RadialMap& map_;
    const RadialProfile& profile_;
    double tolerancePx_;
    const std::stop_token& stop_;
    std::optional<FacetedHeight> best_;
};

}  // namespace

std::optional<PieceMesh> fitRadial(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                                   const std::stop_token& stop) {
    const double asidePx = kAside * tolerancePx;
    std::optional<RadialMap> map = RadialMap::of(projection, sizePx, asidePx);
    if (!map) return std::nullopt;
    std::optional<RadialProfile> profile = RadialProfile::of(*map, asidePx);
    if (!profile) {
        map = map->turnedOver();
        profile = RadialProfile::of(*map, asidePx);
    }
    if (!profile) return std::nullopt;
    if (!(profile->facetCount(tolerancePx) <= kMostPieces)) refuseTolerance(tolerancePx);
    try {
        const auto faceted = RingSearch(*map, *profile, tolerancePx, stop).fewest();
        return faceted ? std::optional(meshOf(*faceted)) : std::nullopt;
    } catch (const std::domain_error&) {
        return std::nullopt;  // a display so full of holes that its facets do not hold on to it
    }
}

}  // namespace curvewall
