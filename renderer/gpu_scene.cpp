#include "renderer/gpu_scene.h"

#include "calibration/errors.h"
#include "renderer/blended_triangles.h"
#include "renderer/meshlets.h"
#include "renderer/stroke_renderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace curvewall {
namespace {

constexpr uint32_t kMostChunkVertices = 5'000'000;   // 60 MB of positions
constexpr uint32_t kMostChunkTriangles = 5'000'000;  // 60 MB of corners
constexpr uint32_t kUnassigned = ~0u;
// They are one chunk, whose largest buffer may have 64 bytes for each.
constexpr size_t kMostBlendedTriangles = 2'000'000;

uint32_t packNormal(glm::vec3 normal) {
    uint32_t bits = 0;
    for (int i = 0; i < 3; ++i) {
        const auto part = static_cast<int32_t>(std::lround(std::clamp(normal[i], -1.0f, 1.0f) * 511));
        bits |= (static_cast<uint32_t>(part) & 0x3ffu) << (10 * i);
    }
    return bits;
}

GpuMeshlet gpuMeshlet(const Meshlet& meshlet, bool isSingleSided) {
    GpuMeshlet gpu;
    gpu.sphere = glm::vec4(meshlet.centreM, meshlet.radiusM);
    gpu.cone = glm::vec4(meshlet.coneAxis, meshlet.coneReachM);
    gpu.firstTriangle = meshlet.firstTriangle;
    gpu.triangleCount = meshlet.triangleCount;
    gpu.isSingleSided = isSingleSided ? 1 : 0;
    gpu.coneSine = meshlet.coneSine;
    gpu.coneCosine = meshlet.coneCosine;
    return gpu;
}

// Collects a chunk's triangles and renumbers their vertices.
class ChunkBuilder {
public:
    ChunkBuilder(const Scene& scene, TriangleOrder order)
        : scene_(scene), order_(order), local_(scene.positions.size(), kUnassigned) {}

    bool hasRoom() const {
        return vertices_.size() + 3 <= kMostChunkVertices && triangles_.size() < kMostChunkTriangles;
    }
    bool isEmpty() const { return triangles_.empty(); }

    void add(glm::uvec3 triangle, uint32_t material) {
        if (ranges_.empty() || ranges_.back().material != material) {
            const bool isSingleSided = !scene_.materials[material].doubleSided;
            ranges_.push_back({material, static_cast<uint32_t>(triangles_.size()), 0, 0, 0, isSingleSided});
        }
        ++ranges_.back().triangleCount;
        triangles_.push_back(localCorners(triangle));
    }

    // The same triangle by the chunk's vertices.
    glm::uvec3 localCorners(glm::uvec3 triangle) {
        for (int i = 0; i < 3; ++i) {
            uint32_t& index = local_[triangle[i]];
            if (index == kUnassigned) {
                index = static_cast<uint32_t>(vertices_.size());
                vertices_.push_back(triangle[i]);
            }
            triangle[i] = index;
        }
        return triangle;
    }

    SceneChunk upload() {
        const std::vector<GpuMeshlet> meshlets = orderByMeshlets();
        SceneChunk chunk = uploadVertices();
        chunk.corners = makeBuffer(std::span<const glm::uvec3>(triangles_));
        chunk.meshlets = makeBuffer(std::span<const GpuMeshlet>(meshlets));
        chunk.vertexArray = vertexArrayOver(chunk);
        chunk.triangleCount = static_cast<uint32_t>(triangles_.size());
        chunk.meshletCount = static_cast<uint32_t>(meshlets.size());
        chunk.ranges = std::exchange(ranges_, {});
        chunk.meshletBounds = std::exchange(meshlets_, {});
        triangles_.clear();
        return chunk;
    }

    SceneChunk uploadVertices() {
        SceneChunk chunk;
        std::vector<glm::vec3> positions;
        std::vector<uint32_t> normals;
        std::vector<glm::vec2> uvs;
        for (uint32_t vertex : vertices_) {
            positions.push_back(scene_.positions[vertex]);
            normals.push_back(packNormal(scene_.normals[vertex]));
            uvs.push_back(scene_.uvs[vertex]);
            local_[vertex] = kUnassigned;
        }
        chunk.positions = makeBuffer(std::span<const glm::vec3>(positions));
        chunk.normals = makeBuffer(std::span<const uint32_t>(normals));
        chunk.uvs = makeBuffer(std::span<const glm::vec2>(uvs));
        vertices_.clear();
        return chunk;
    }

private:
    // Brings the triangles into the order of their meshlets.
    std::vector<GpuMeshlet> orderByMeshlets() {
        std::vector<glm::vec3> positions;
        for (uint32_t vertex : vertices_) positions.push_back(scene_.positions[vertex]);
        std::vector<GpuMeshlet> meshlets;
        for (ChunkRange& range : ranges_) {
            const std::vector<glm::uvec3> before(
                triangles_.begin() + range.firstTriangle,
                triangles_.begin() + range.firstTriangle + range.triangleCount);
            const Meshlets cut = order_ == TriangleOrder::asGiven ? cutInOrder(positions, before)
                                                                  : cutIntoMeshlets(positions, before);
            for (uint32_t i = 0; i < range.triangleCount; ++i)
                triangles_[range.firstTriangle + i] = before[cut.order[i]];
            range.firstMeshlet = static_cast<uint32_t>(meshlets.size());
            range.meshletCount = static_cast<uint32_t>(cut.meshlets.size());
            for (Meshlet meshlet : cut.meshlets) {
                meshlet.firstTriangle += range.firstTriangle;
                meshlets_.push_back(meshlet);
                meshlets.push_back(gpuMeshlet(meshlet, range.isSingleSided));
            }
        }
        return meshlets;
    }

    const Scene& scene_;
    TriangleOrder order_;
    std::vector<uint32_t> local_;     // scene vertex -> chunk vertex
    std::vector<uint32_t> vertices_;  // chunk vertex -> scene vertex
    std::vector<glm::uvec3> triangles_;
    std::vector<ChunkRange> ranges_;
    std::vector<Meshlet> meshlets_;
};

std::vector<SceneChunk> uploadChunks(const Scene& scene, TriangleOrder order) {
    std::vector<SceneChunk> chunks;
    ChunkBuilder builder(scene, order);
    for (const MaterialRange& range : scene.ranges) {
        if (scene.materials[range.material].blending != Blending::none) continue;
        for (uint32_t i = 0; i < range.triangleCount; ++i) {
            if (!builder.hasRoom()) chunks.push_back(builder.upload());
            builder.add(scene.triangles[range.firstTriangle + i], range.material);
        }
    }
    if (!builder.isEmpty()) chunks.push_back(builder.upload());
    return chunks;
}

GlTexture uploadTexture(const Texture& texture) {
    GLint mostPx = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostPx);
    const glm::ivec2 sizePx = texture.levels.front().sizePx;
    if (std::max(sizePx.x, sizePx.y) > mostPx)
        throw UsageError("texture \"" + texture.name + "\" is larger than the " + std::to_string(mostPx) +
                         " px that this OpenGL allows");
    GlTexture uploaded = makeTexture2D(GL_SRGB8_ALPHA8, sizePx, static_cast<int>(texture.levels.size()));
    for (size_t i = 0; i < texture.levels.size(); ++i) {
        const MipLevel& level = texture.levels[i];
        glTextureSubImage2D(uploaded.id(), static_cast<GLint>(i), 0, 0, level.sizePx.x, level.sizePx.y,
                            GL_RGBA, GL_UNSIGNED_BYTE, level.texels.data());
    }
    return uploaded;
}

GLint glWrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::clampToEdge:
            return GL_CLAMP_TO_EDGE;
        case Wrap::mirroredRepeat:
            return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

GlSampler makeSampler(const Texture& texture) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    GlSampler sampler(id);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, glWrap(texture.wrapS));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, glWrap(texture.wrapT));
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return sampler;
}

std::shared_ptr<BlendedTriangles> uploadBlended(const Scene& scene) {
    ChunkBuilder builder(scene, TriangleOrder::asGiven);
    std::vector<BlendedTriangles::Triangle> triangles;
    for (const MaterialRange& range : scene.ranges) {
        const Material& material = scene.materials[range.material];
        if (material.blending == Blending::none) continue;
        for (uint32_t i = 0; i < range.triangleCount; ++i) {
            const glm::uvec3 corners = scene.triangles[range.firstTriangle + i];
            const glm::vec3 centre =
                (scene.positions[corners.x] + scene.positions[corners.y] + scene.positions[corners.z]) / 3.0f;
            triangles.push_back(
                {builder.localCorners(corners), centre, range.material, !material.doubleSided});
        }
    }
    if (triangles.empty()) return nullptr;
    if (triangles.size() > kMostBlendedTriangles)
        throw UsageError("the scene has " + std::to_string(triangles.size()) +
                         " triangles that mix with what is behind them, more than the " +
                         std::to_string(kMostBlendedTriangles) + " that are sorted in every frame");
    return std::make_shared<BlendedTriangles>(builder.uploadVertices(), std::move(triangles));
}

}  // namespace

GlVertexArray vertexArrayOver(const SceneChunk& chunk) {
    GlVertexArray array = makeVertexArray();
    const auto attribute = [&](GLuint index, const GlBuffer& buffer, GLsizei stride, GLint size, GLenum type,
                               GLboolean normalized) {
        glVertexArrayVertexBuffer(array.id(), index, buffer.id(), 0, stride);
        glVertexArrayAttribFormat(array.id(), index, size, type, normalized, 0);
        glVertexArrayAttribBinding(array.id(), index, index);
        glEnableVertexArrayAttrib(array.id(), index);
    };
    attribute(0, chunk.positions, sizeof(glm::vec3), 3, GL_FLOAT, GL_FALSE);
    attribute(1, chunk.normals, sizeof(uint32_t), 4, GL_INT_2_10_10_10_REV, GL_TRUE);
    attribute(2, chunk.uvs, sizeof(glm::vec2), 2, GL_FLOAT, GL_FALSE);
    glVertexArrayElementBuffer(array.id(), chunk.corners.id());
    return array;
}

GpuScene uploadScene(ScenePtr scene, TriangleOrder order) {
    GpuScene uploaded;
    uploaded.chunks = uploadChunks(*scene, order);
    uploaded.blended = uploadBlended(*scene);
    for (const Texture& texture : scene->textures) {
        uploaded.textures.push_back(uploadTexture(texture));
        uploaded.samplers.push_back(makeSampler(texture));
    }
    if (hasStrokes(*scene)) uploaded.strokes = std::make_shared<StrokeScene>(*scene);
    uploaded.scene = std::move(scene);
    return uploaded;
}

void setAnisotropy(const GpuScene& scene, int anisotropy) {
    if (!epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") &&
        !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        return;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
    for (const GlSampler& sampler : scene.samplers)
        glSamplerParameterf(sampler.id(), GL_TEXTURE_MAX_ANISOTROPY,
                            std::min(static_cast<GLfloat>(anisotropy), most));
}

uint64_t meshletCountOf(const GpuScene& scene) {
    uint64_t count = scene.blended ? scene.blended->chunk().meshletCount : 0;
    for (const SceneChunk& chunk : scene.chunks) count += chunk.meshletCount;
    return count;
}

size_t memoryBytesOf(const GpuScene& scene) {
    size_t bytes = 0;
    const auto add = [&bytes](const SceneChunk& chunk) {
        for (const GlBuffer* buffer :
             {&chunk.positions, &chunk.normals, &chunk.uvs, &chunk.corners, &chunk.meshlets, &chunk.across})
            bytes += sizeOf(*buffer);
    };
    for (const SceneChunk& chunk : scene.chunks) add(chunk);
    if (scene.blended) add(scene.blended->chunk());
    if (scene.strokes) {
        for (const SceneChunk& chunk : scene.strokes->gpu.chunks) add(chunk);
        bytes += scene.strokes->coverage.memoryBytes();
    }
    for (const Texture& texture : scene.scene->textures)
        for (const MipLevel& level : texture.levels) bytes += sizeof(glm::u8vec4) * level.texels.size();
    return bytes;
}

}  // namespace curvewall
