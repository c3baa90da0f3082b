#include "renderer/gpu_edges.h"

#include "renderer/blended_triangles.h"
#include "renderer/edge_neighbours.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace curvewall {
namespace {

// As shaders/edges.glsl reads it.
constexpr uint32_t kNothingAcross = 0xffffffffu;
constexpr uint32_t kCrease = 0x80000000u;
constexpr uint32_t kElsewhere = 0x7fffffffu;

// Where a chunk begins in the whole scene.
struct ChunkStart {
    uint32_t vertex, triangle;
};

template <class T>
void appendFrom(const GlBuffer& buffer, std::vector<T>& values, size_t count) {
    values.resize(values.size() + count);
    glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(sizeof(T) * count),
                            values.data() + values.size() - count);
}

size_t vertexCountOf(const SceneChunk& chunk) { return sizeOf(chunk.positions) / sizeof(glm::vec3); }

// The chunks as one mesh again: their triangles may be in another order than the scene's.
struct WholeMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<ChunkStart> starts;  // and the end behind the last

    explicit WholeMesh(std::span<const SceneChunk> chunks) {
        for (const SceneChunk& chunk : chunks) {
            const ChunkStart start{static_cast<uint32_t>(positions.size()),
                                   static_cast<uint32_t>(triangles.size())};
            starts.push_back(start);
            appendFrom(chunk.positions, positions, vertexCountOf(chunk));
            appendFrom(chunk.corners, triangles, chunk.triangleCount);
            for (size_t i = start.triangle; i < triangles.size(); ++i) triangles[i] += start.vertex;
        }
        starts.push_back({static_cast<uint32_t>(positions.size()), static_cast<uint32_t>(triangles.size())});
    }
};

uint32_t packed(const EdgeNeighbour& neighbour, uint32_t firstVertex, uint32_t endVertex) {
    if (!neighbour.exists()) return kNothingAcross;
    const bool here = neighbour.corner >= firstVertex && neighbour.corner < endVertex;
    return (here ? neighbour.corner - firstVertex : kElsewhere) | (neighbour.isCrease ? kCrease : 0);
}

std::vector<uint32_t> acrossOf(const std::vector<glm::vec3>& positions,
                               const std::vector<glm::uvec3>& triangles) {
    std::vector<uint32_t> across;
    for (const EdgeNeighbour& neighbour : edgeNeighbours(positions, triangles))
        across.push_back(packed(neighbour, 0, static_cast<uint32_t>(positions.size())));
    return across;
}

void uploadBlendedEdges(BlendedTriangles& blended) {
    std::vector<glm::vec3> positions;
    appendFrom(blended.chunk().positions, positions, vertexCountOf(blended.chunk()));
    blended.setAcross(acrossOf(positions, blended.corners()));
}

}  // namespace

void uploadEdges(GpuScene& scene) {
    if (scene.blended && !scene.blended->chunk().across) uploadBlendedEdges(*scene.blended);
    if (scene.chunks.empty() || scene.chunks.front().across) return;
    const WholeMesh mesh(scene.chunks);
    const std::vector<EdgeNeighbour> neighbours = edgeNeighbours(mesh.positions, mesh.triangles);
    for (size_t i = 0; i < scene.chunks.size(); ++i) {
        const ChunkStart start = mesh.starts[i], end = mesh.starts[i + 1];
        std::vector<uint32_t> across;
        for (size_t edge = 3 * size_t{start.triangle}; edge < 3 * size_t{end.triangle}; ++edge)
            across.push_back(packed(neighbours[edge], start.vertex, end.vertex));
        scene.chunks[i].across = makeBuffer(std::span<const uint32_t>(across));
    }
}

}  // namespace curvewall
