#pragma once
// The end of a raster frame: on a display with maps the picture is drawn in linear float, and one last pass
// blends and encodes it. Without maps the picture's own target is the result and nothing is added.

#include "calibration/blending/blend.h"
#include "renderer/frame_target.h"
#include "renderer/gl/program.h"

#include <memory>
#include <optional>

namespace curvewall {

// The maps of one display in GPU memory with the program that reads them.
struct GpuBlend {
    GlTexture alpha, beta;  // zero where there is no map
    GlProgram program;
};

GpuBlend uploadBlend(const BlendMaps& maps, glm::ivec2 sizePx);

class BlendedTarget {
public:
    // `maps` is null where there are none and for outputs other than colour.
    BlendedTarget(glm::ivec2 sizePx, TargetFormat format, std::shared_ptr<const GpuBlend> maps);

    // What the picture has to be drawn in.
    TargetFormat pictureFormat() const;

    // Records the last pass over the finished picture.
    void record(const FrameTarget& picture) const;

    // Waits for the GPU. Never within a frame.
    Frame read(const FrameTarget& picture) const { return target_ ? target_->read() : picture.read(); }

    size_t memoryBytes() const;  // of its own picture
    size_t mapBytes() const;

private:
    TargetFormat format_;
    std::shared_ptr<const GpuBlend> maps_;
    std::optional<FrameTarget> target_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
