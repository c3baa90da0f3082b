#pragma once
// The second step of the image-based method: every pixel is looked up in the pictures of a source.

#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/image_source.h"
#include "renderer/lookup_mesh.h"
#include "renderer/source_lookup.h"

#include <vector>

namespace curvewall {

// Light may be blended between texels; distances, counts and points may not.
inline SourceFilter filterFor(OutputKind output, SourceFilter asked) {
    return output == OutputKind::color ? asked : SourceFilter::nearest;
}

// One or the other.
struct GpuLookup {
    GlTexture places, gradients;  // of all pixels; gradients only for what uses levels
    GlBuffer cells;               // of the mesh
    GLsizei cellCount = 0;
};

// `places` and `gradients` as sourcePlaces and sourceGradients give them; the latter may be empty.
GpuLookup uploadLookup(const std::vector<glm::vec4>& places, const std::vector<glm::vec4>& gradients,
                       glm::ivec2 sizePx);
GpuLookup uploadLookup(const std::vector<LookupCell>& mesh);

class Resampler {
public:
    Resampler(SourceFilter filter, SourceLookup lookup);

    // Draws all of `target`. `pictures` is a texture with layers, and levels where the filter uses them.
    void record(const GlTexture& pictures, const GpuLookup& lookup, const FrameTarget& target,
                glm::vec3 background) const;

private:
    SourceLookup lookup_;
    GlProgram program_;
    GlSampler sampler_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
