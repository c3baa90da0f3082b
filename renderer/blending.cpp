#include "renderer/blending.h"

#include "calibration/parallel.h"

namespace curvewall {

void blend(Frame& frame, const BlendMaps& maps, float most) {
    const auto width = static_cast<size_t>(frame.sizePx.x);
    const auto blendPixel = [&](size_t pixel) {
        float* texel = &frame.texels[3 * pixel];
        const glm::vec3 alpha = maps.alpha.empty() ? glm::vec3(1) : maps.alpha[pixel];
        const glm::vec3 beta = maps.beta.empty() ? glm::vec3(0) : maps.beta[pixel];
        const glm::vec3 shown = blending::blended({texel[0], texel[1], texel[2]}, alpha, beta, most);
        for (int c = 0; c < 3; ++c) texel[c] = shown[c];
    };
    parallelRanges(frame.sizePx.y, [&](int begin, int end) {
        for (size_t pixel = static_cast<size_t>(begin) * width; pixel < static_cast<size_t>(end) * width;
             ++pixel)
            blendPixel(pixel);
    });
}

}  // namespace curvewall
