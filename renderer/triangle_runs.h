#pragma once
// Runs of a chunk's triangles, drawn from plain vertices in one call.

#include "renderer/material_binder.h"

#include <cstdint>
#include <vector>

namespace curvewall {

class TriangleRuns {
public:
    void clear();
    // Runs that touch become one.
    void add(uint32_t firstTriangle, uint32_t triangleCount);
    bool isEmpty() const { return cornerCounts_.empty(); }

    // With the program, and the chunk by bindVertices(), that are current.
    void draw(const ScenePrograms& programs) const;

private:
    std::vector<GLint> firstCorners_;
    std::vector<GLsizei> cornerCounts_;
    std::vector<const void*> firstIndices_;
};

}  // namespace curvewall
