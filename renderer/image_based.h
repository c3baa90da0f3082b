#pragma once
// What installations run today: render a cube map, then resample it through the exact map, pixel by pixel. In
// Lorenz and Doellner (2009), section 1.1, this is the image-based approach; SGCT renders fisheyes this way.

#include "renderer/frame_target.h"
#include "renderer/piecewise.h"

#include <array>
#include <memory>
#include <vector>

namespace curvewall {

class ImageBasedRenderer {
public:
    // Draws the faces in `faces` at `faceSizePx`; the facets are `distanceM` from the eye, which places the
    // near cut. `rays` as displayRays gives them, `sizePx` their display's. The scene must outlive it.
    ImageBasedRenderer(const GpuScene& scene, const std::vector<glm::vec4>& rays, glm::ivec2 sizePx,
                       int faceSizePx, std::array<bool, 6> faces, double distanceM, SceneLook look,
                       TargetFormat format);

    // Draws the faces, then the display into `target`. Records GL work only.
    void record(const SceneView& view, const FrameTarget& target, glm::vec3 background);

    uint64_t pairCount() const;  // triangles submitted a frame, over all faces

private:
    struct Face {
        GpuPieces pieces;
        GlFramebuffer framebuffer;
        std::unique_ptr<PiecewiseRenderer> renderer;
    };

    const GpuScene& scene_;
    int faceSizePx_;
    OutputKind output_;
    GlTexture rays_, cube_;
    GlSampler sampler_;
    GlRenderbuffer depth_;
    std::vector<Face> faces_;
    GlProgram resample_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
