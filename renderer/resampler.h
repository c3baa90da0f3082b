#pragma once
// The second step of the image-based method: every pixel looks its exact ray up in the pictures of a source.

#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/image_source.h"

namespace curvewall {

// Light may be blended between texels; distances, counts and points may not.
inline SourceFilter filterFor(OutputKind output, SourceFilter asked) {
    return output == OutputKind::color ? asked : SourceFilter::nearest;
}

class Resampler {
public:
    explicit Resampler(SourceFilter filter);

    // Draws all of `target`. `pictures` is a texture with layers; `places` as uploadPlaces made it.
    void record(const GlTexture& pictures, const GlTexture& places, const FrameTarget& target,
                glm::vec3 background) const;

private:
    GlProgram program_;
    GlSampler sampler_;
    GlVertexArray emptyVertexArray_;
};

// `places` as sourcePlaces gives them.
GlTexture uploadPlaces(const std::vector<glm::vec4>& places, glm::ivec2 sizePx);

}  // namespace curvewall
