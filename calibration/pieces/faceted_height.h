#pragma once
// The facets of a round display and the cells in which they are the lowest, relaxed towards the smallest
// error.

#include "calibration/pieces/plane_envelope.h"
#include "calibration/pieces/radial_map.h"
#include "calibration/pieces/radial_profile.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace curvewall {

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

class FacetedHeight {
public:
    // Throws std::domain_error as lowestPlanes does; so does relax.
    FacetedHeight(const RadialMap& map, std::vector<RadialFacet> facets);

    const RadialMap& map() const { return map_; }
    const std::vector<RadialFacet>& facets() const { return facets_; }
    const std::vector<FacetCell>& cells() const { return cells_; }  // of the facets, in their order
    const std::vector<glm::dvec2>& cornersPx() const { return envelope_.corners; }
    double errorPx() const;  // over all samples

    // Lloyd's step: every facet is fitted to its cell, then the cells follow the facets. Facets without a
    // cell are dropped.
    void relax(double tolerancePx, int lawsonSteps, int samplesOutward);

private:
    void rebuild(int samplesOutward);
    FacetCell cellOf(const RadialFacet& facet, std::vector<uint32_t> corners, int samplesOutward) const;
    std::vector<glm::dvec2> outlineOf(glm::dvec2 sitePx, const std::vector<uint32_t>& corners) const;
    void addBetween(glm::dvec2 sitePx, std::vector<glm::dvec2>& rim) const;

    RadialMap map_;
    std::vector<RadialFacet> facets_;
    PlaneEnvelope envelope_;  // its cells are in cells_
    std::vector<FacetCell> cells_;
};

// Where the display ends on the way from a place that it shows.
glm::dvec2 lastShown(const RadialMap& map, glm::dvec2 on, glm::dvec2 off);

}  // namespace curvewall
