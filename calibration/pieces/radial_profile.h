#pragma once
// How a round display bends from its centre to its rim, and the first facets for it: rings of tangent planes.

#include "calibration/pieces/plane_envelope.h"
#include "calibration/pieces/radial_map.h"

#include <optional>
#include <vector>

namespace curvewall {

// A facet of a radial map, with the place on the screen that its cell is about.
struct RadialFacet {
    glm::dvec2 sitePx{0};
    HeightPlane plane;
};

class RadialProfile {
public:
    // Nothing where the heights are not those of a round display that bends down everywhere, to
    // `mostAsidePx`.
    static std::optional<RadialProfile> of(const RadialMap& map, double mostAsidePx);

    // Facets of the thinnest covering of the display with hexagons.
    double facetCount(double tolerancePx) const;

    // Rings from the centre to the rim that such a covering has.
    double rowsFor(double tolerancePx) const;

    // One facet and `rows` rings about it, which share the bend, with `density` times as many facets around
    // as that covering has.
    std::vector<RadialFacet> rings(double tolerancePx, int rows, double density) const;

private:
    struct Step {
        double radius = 0;      // on the flat screen
        double slope = 0;       // of the height
        double bend = 0;        // in px an unit of length squared, along the radius
        double bendAround = 0;  // and across it
    };

    explicit RadialProfile(const RadialMap& map) : map_(map) {}
    std::vector<double> bendLengths(double tolerancePx) const;
    std::optional<double> heightAt(double radius) const {
        return map_.height(map_.pxAt(radius * direction_));
    }
    double reach(glm::dvec2 direction) const;
    std::optional<Step> stepAt(double radius, double rim) const;
    bool isRound(double mostAsidePx) const;

    RadialMap map_;
    glm::dvec2 direction_{1, 0};  // in which the display reaches farthest
    std::vector<Step> steps_;     // from the centre to the rim
};

// How far a ray lands from its place, in px, for each unit of height that a facet is off there.
double pxPerHeight(const RadialMap& map, const HeightPlane& plane, glm::dvec2 px);

}  // namespace curvewall
