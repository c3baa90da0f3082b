#pragma once
// A frame with any number of samples a pixel: multisampled as far as the driver goes, beyond that drawn once
// a sample, each time shifted by a part of a pixel, and averaged in linear light.

#include "renderer/frame_pass.h"
#include "renderer/frame_target.h"
#include "renderer/gl/program.h"

#include <functional>
#include <optional>
#include <vector>

namespace curvewall {

class SampledTarget {
public:
    SampledTarget(glm::ivec2 sizePx, TargetFormat format, int samples);

    size_t passCount() const { return passes_.size(); }
    int samplesAPass() const { return passes_.front().samples; }
    // Where the samples of all passes lie, from their pixel's top left corner.
    std::vector<glm::dvec2> sampleOffsetsPx() const;

    // Calls record for every pass.
    void draw(glm::vec3 background, const std::function<void(const FramePass&)>& record) const;

    // Where the finished picture is.
    const FrameTarget& picture() const { return sum_ ? *sum_ : target_; }

    size_t memoryBytes() const { return target_.memoryBytes() + (sum_ ? sum_->memoryBytes() : 0); }

private:
    void addPass() const;

    std::vector<FramePass> passes_;
    FrameTarget target_;
    std::optional<FrameTarget> sum_;  // linear; only where there are several passes
    GlProgram addProgram_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
