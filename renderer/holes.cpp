#include "renderer/holes.h"

namespace curvewall {

void closeHoles(const GlProgram& program, const GpuOwners& owners, glm::ivec2 sizePx,
                const GlVertexArray& emptyVertexArray) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glUseProgram(program.id());
    glBindTextureUnit(1, owners.texture.id());
    glBindVertexArray(emptyVertexArray.id());
    bindStorage(0, owners.holeTiles);
    glProgramUniform2f(program.id(), 0, static_cast<float>(sizePx.x), static_cast<float>(sizePx.y));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, owners.holeTileCount);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace curvewall
