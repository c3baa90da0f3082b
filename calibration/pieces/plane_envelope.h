#pragma once
// The lowest of many planes over a display: convex cells that meet edge to edge.

#include <glm/vec2.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace curvewall {

// A height over the screen, a + b . s.
struct HeightPlane {
    double atOrigin = 0;
    glm::dvec2 slope{0};

    HeightPlane operator-(const HeightPlane& other) const {
        return {atOrigin - other.atOrigin, slope - other.slope};
    }
    double at(glm::dvec2 px) const { return atOrigin + slope.x * px.x + slope.y * px.y; }
};

// Numbers places on the screen, the same for those that only rounding tells apart.
class PlacesPx {
public:
    // The next number for a place that has none.
    uint32_t numberOf(glm::dvec2 px);

    const std::vector<glm::dvec2>& all() const { return places_; }

private:
    std::vector<glm::dvec2> places_;
    std::unordered_multimap<uint64_t, uint32_t> numbers_;
};

struct PlaneEnvelope {
    std::vector<glm::dvec2> corners;  // px
    std::vector<std::vector<uint32_t>>
        cells;  // of each plane: corners in order, none where it is nowhere lowest
};

// The cells of the display in which each plane is the lowest. Cells that meet share their corners. Throws
// std::domain_error for planes that are too many sizes apart to be compared.
PlaneEnvelope lowestPlanes(const std::vector<HeightPlane>& planes, glm::ivec2 sizePx);

}  // namespace curvewall
