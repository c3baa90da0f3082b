#pragma once
// The pictures of an image source on the GPU: layers of one texture.

#include "renderer/face_pass.h"
#include "renderer/sampled_target.h"

#include <vector>

namespace curvewall {

struct PicturesLayout {
    glm::ivec2 layerSizePx{0};
    std::vector<glm::ivec2> sizesPx;  // what each picture fills of its layer, from the top left corner
    int levels = 0;                   // of halved pictures beside the whole ones
    FacePass pass = FacePass::separate;

    bool operator==(const PicturesLayout&) const = default;
};

class FacePictures {
public:
    // One layer at least, so that there is always a texture to read. Throws UsageError where layers are to
    // have more samples than the driver has.
    FacePictures(const PicturesLayout& layout, TargetFormat format, int samples);

    // Calls record for every pass of the picture. Only for those that are separate.
    void draw(size_t picture, glm::vec3 background,
              const std::function<void(const FramePass&)>& record) const;

    // Calls record once. Only for those that are layered.
    void drawAll(glm::vec3 background, const std::function<void(const FramePass&)>& record) const;

    // After all pictures are drawn, where there are levels.
    void makeLevels() const;

    const GlTexture& texture() const { return texture_; }
    size_t memoryBytes() const;

private:
    void makeSeparate(int samples);
    void makeLayered(int samples);

    PicturesLayout layout_;
    TargetFormat format_;
    GlTexture texture_;
    std::vector<GlFramebuffer> layers_;  // each with its layer of the texture

    GlRenderbuffer depth_;                  // separate, of one sample a texel
    std::optional<SampledTarget> samples_;  // separate, where there are more

    GlTexture allDepths_, allSamples_;  // layered, the second where there are several a texel
    GlFramebuffer all_;
    std::vector<GlFramebuffer> sampledLayers_;
};

}  // namespace curvewall
