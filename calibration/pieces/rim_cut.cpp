#include "calibration/pieces/rim_cut.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace curvewall {
namespace {

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

}  // namespace

std::vector<std::vector<glm::dvec2>> cellsCutAtRim(const FacetedHeight& faceted) {
    const RimCut rim(faceted);
    std::vector<std::vector<glm::dvec2>> cells;
    for (const FacetCell& cell : faceted.cells()) cells.push_back(rim.cornersOf(cell));
    return cells;
}

}  // namespace curvewall
