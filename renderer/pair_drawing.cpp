#include "renderer/pair_drawing.h"

#include <algorithm>

namespace curvewall {

uint32_t mostPairsInBuffer() {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    // Draw commands count vertices in 32 bits, three a pair.
    return static_cast<uint32_t>(std::min<uint64_t>(static_cast<uint64_t>(bytes) / kPairBytes, 1u << 30));
}

void drawPairs(const SceneChunk& chunk, std::span<const ChunkRange> ranges, const GlBuffer& pairs,
               const GlBuffer& commands, const MaterialBinder& materials, GLenum primitive) {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
    materials.bindPulled(chunk);
    bindStorage(5, commands);
    bindStorage(6, pairs);
    for (size_t r = 0; r < ranges.size(); ++r) {
        const GLuint program = materials.bind(ranges[r].material);
        glProgramUniform1ui(program, 13, static_cast<GLuint>(r));
        glDrawArraysIndirect(primitive, reinterpret_cast<const void*>(kDrawCommandBytes * r));
    }
}

}  // namespace curvewall
