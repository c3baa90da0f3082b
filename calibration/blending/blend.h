#pragma once
// What a display does to the finished picture where it overlaps its neighbours and where it is never black.

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace curvewall {

// One value a channel and pixel, row by row from the top, in linear light; empty where there is no map.
struct BlendMaps {
    std::vector<glm::vec3> alpha;  // what remains of the picture
    std::vector<glm::vec3> beta;   // the black level

    bool empty() const { return alpha.empty() && beta.empty(); }
};

// Shared by all that know the same display, such as the same wall for another eye.
using BlendMapsPtr = std::shared_ptr<const BlendMaps>;

// Factors of the picture, one a pixel in linear light, on top of what is there.
inline void multiplyPicture(BlendMaps& maps, const std::vector<float>& factors) {
    if (factors.empty()) return;
    if (maps.alpha.empty()) maps.alpha.assign(factors.size(), glm::vec3(1));
    for (size_t i = 0; i < factors.size(); ++i) maps.alpha[i] *= factors[i];
}

}  // namespace curvewall
