#include "calibration/pieces/radial_fit.h"

#include "calibration/pieces/faceted_height.h"
#include "calibration/pieces/fit_stop.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/radial_map.h"
#include "calibration/pieces/radial_profile.h"
#include "calibration/pieces/rim_cut.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace curvewall {
namespace {

constexpr double kAside = 0.02;  // of the tolerance: how far a display may be from round
// Least squares first; then the largest error is sought, closely in the end.
constexpr int kPlainSteps = 10, kMinimaxSteps = 6, kCloseSteps = 4;
constexpr int kLawsonSteps = 6, kCloseLawsonSteps = 10;
constexpr int kSamplesOutward = 2, kCloseSamplesOutward = 5;

// Pieces that a facet of so many edges becomes.
size_t partCount(size_t edges) { return std::max<size_t>(1, (edges - 3) / (kMostPieceEdges - 2) + 1); }

PieceMesh meshOf(const FacetedHeight& faceted) {
    PieceMesh mesh{faceted.map().sizePx(), {}, {}};
    const std::vector<std::vector<glm::dvec2>> cells = cellsCutAtRim(faceted);
    PlacesPx places;
    for (size_t k = 0; k < cells.size(); ++k) {
        const HeightPlane& plane = faceted.facets()[k].plane;
        std::vector<uint32_t> around;
        for (glm::dvec2 px : cells[k]) {
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
