#pragma once
// The pictures of an image source on the GPU: layers of one texture, drawn one after the other.

#include "renderer/sampled_target.h"

namespace curvewall {

class FacePictures {
public:
    // One picture at least, so that there is always a texture to read.
    FacePictures(glm::ivec2 sizePx, size_t count, TargetFormat format, int samples);

    // Calls record for every pass of the picture.
    void draw(size_t picture, glm::vec3 background,
              const std::function<void(const FramePass&)>& record) const;

    const GlTexture& texture() const { return texture_; }

private:
    glm::ivec2 sizePx_;
    TargetFormat format_;
    GlTexture texture_;
    GlRenderbuffer depth_;                  // of one sample a texel
    std::optional<SampledTarget> samples_;  // where there are more
    std::vector<GlFramebuffer> layers_;
};

}  // namespace curvewall
