#include "renderer/triangle_runs.h"

namespace curvewall {

void TriangleRuns::clear() {
    firstCorners_.clear();
    cornerCounts_.clear();
    firstIndices_.clear();
}

void TriangleRuns::add(uint32_t firstTriangle, uint32_t triangleCount) {
    const auto first = static_cast<GLint>(3 * firstTriangle);
    const auto count = static_cast<GLsizei>(3 * triangleCount);
    if (!isEmpty() && firstCorners_.back() + cornerCounts_.back() == first) {
        cornerCounts_.back() += count;
        return;
    }
    firstCorners_.push_back(first);
    cornerCounts_.push_back(count);
    firstIndices_.push_back(reinterpret_cast<const void*>(sizeof(glm::uvec3) * firstTriangle));
}

void TriangleRuns::draw(const ScenePrograms& programs) const {
    const auto runs = static_cast<GLsizei>(cornerCounts_.size());
    if (programs.drawsEdges())  // pulls its corners by their numbers
        glMultiDrawArrays(GL_TRIANGLES, firstCorners_.data(), cornerCounts_.data(), runs);
    else
        glMultiDrawElements(GL_TRIANGLES, cornerCounts_.data(), GL_UNSIGNED_INT, firstIndices_.data(), runs);
}

}  // namespace curvewall
