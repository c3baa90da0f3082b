#pragma once
// Pixels that a display shows nothing at keep the background.

#include "renderer/gl/gl_handle.h"
#include "renderer/gpu_pieces.h"

namespace curvewall {

// Nothing is nearer than a hole, and unlike a fragment that is discarded it leaves the early depth test on.
// `program` is of holes.vert and holes.frag. Clip planes must be off.
void closeHoles(const GlProgram& program, const GpuOwners& owners, glm::ivec2 sizePx,
                const GlVertexArray& emptyVertexArray);

}  // namespace curvewall
