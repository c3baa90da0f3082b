#pragma once
// The truth that the other methods are judged by: exact rays through Embree, one per sample.
// It shares nothing with the raster methods but Projection, the scene's texels and the shading formula.

#include "calibration/wall.h"
#include "renderer/camera.h"
#include "renderer/frame.h"
#include "renderer/look.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <memory>

namespace curvewall {

class ReferenceRenderer {
public:
    // Builds the ray tracing structure; keeps a reference to the scene.
    explicit ReferenceRenderer(ScenePtr scene);
    ~ReferenceRenderer();
    ReferenceRenderer(ReferenceRenderer&&) noexcept;
    ReferenceRenderer& operator=(ReferenceRenderer&&) noexcept;

    struct Options {
        Style style = Style::textured;
        OutputKind output = OutputKind::color;
        int samples = 1;    // rays per pixel: 1 casts the pixel centre, n a stratified, seeded pattern
        int threads = 0;    // 0: all cores; the picture does not depend on it
        uint64_t seed = 0;  // of the pattern, for pictures that are averaged
    };
    // Colour is mixed and averaged in linear light; the other outputs are of the pixel's centre. What blends
    // counts as cover and leaves depth and position to what it does not hide.
    // Textures are filtered by the footprint of the sample (ray differentials, trilinear).
    Frame render(const Wall& wall, const Display& display, const Camera& camera,
                 const Options& options) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace curvewall
