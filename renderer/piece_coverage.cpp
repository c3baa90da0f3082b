#include "renderer/piece_coverage.h"

namespace curvewall {

void bindForCoverage(const SceneChunk& chunk, const GpuPieces& pieces) {
    bindStorage(0, chunk.positions);
    bindStorage(1, chunk.corners);
    bindStorage(2, pieces.nodes);
    bindStorage(8, pieces.corners);
    bindStorage(9, pieces.pieces);
}

void setForCoverage(GLuint program, const GpuPieces& pieces, glm::vec4 sampleGrid) {
    glProgramUniform1ui(program, 4, pieces.nodeCount);
    glProgramUniform4fv(program, 16, 1, &sampleGrid[0]);
    glProgramUniform1ui(program, 19, static_cast<GLuint>(3 + pieces.clipPlanes));
}

void setView(GLuint program, const SceneView& view) {
    glProgramUniformMatrix3fv(program, 0, 1, GL_FALSE, &view.wallFromScene[0][0]);
    glProgramUniform3fv(program, 1, 1, &view.originFromEyeM[0]);
}

}  // namespace curvewall
