#include "renderer/material_binder.h"

namespace curvewall {

GLuint MaterialBinder::bind(uint32_t index) const {
    const Material& material = scene.scene->materials[index];
    const ScenePrograms::Chosen chosen = programs.choose(material);
    if (chosen.textured) {
        const auto texture = static_cast<size_t>(material.texture);
        glBindTextureUnit(0, scene.textures[texture].id());
        glBindSampler(0, scene.samplers[texture].id());
    }
    if (chosen.blended)
        glBlendFunc(GL_SRC_ALPHA, material.blending == Blending::alpha ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    return chosen.program;
}

void MaterialBinder::bindVertices(const SceneChunk& chunk) const {
    glBindVertexArray(chunk.vertexArray.id());
    if (programs.drawsEdges()) bindPulled(chunk);
}

void MaterialBinder::bindPulled(const SceneChunk& chunk) const {
    bindStorage(0, chunk.positions);
    bindStorage(1, chunk.corners);
    bindStorage(3, chunk.normals);
    bindStorage(4, chunk.uvs);
    if (programs.drawsEdges()) bindStorage(7, chunk.across);
}

}  // namespace curvewall
