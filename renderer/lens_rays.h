#pragma once
// The rays of a round lens's picture in GPU memory. Looked up rather than computed where they are needed,
// they are the same to the last bit for every program, and not the driver's sines and cosines but series tell
// them.

#include "renderer/gl/gl_objects.h"
#include "renderer/gl/program.h"
#include "renderer/round_lens.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace curvewall {

class LensRays {
public:
    // Room for so many rays a pixel.
    LensRays(const RoundLens& lens, int samples);

    // Computes them for samples that lie at `offsetsPx` from their pixel's top left corner, where they are
    // not there yet. Records GL work only.
    void fill(std::span<const glm::dvec2> offsetsPx);

    const GlTexture& texture() const { return texture_; }  // an array of RGBA32F, one layer a sample
    const RoundLens& lens() const { return lens_; }

private:
    RoundLens lens_;
    GlTexture texture_;
    GlProgram program_;
    std::vector<glm::dvec2> filledAt_;
};

}  // namespace curvewall
