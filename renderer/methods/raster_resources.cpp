#include "renderer/methods/raster_resources.h"

#include "renderer/gpu_edges.h"

#include <stdexcept>

namespace curvewall {

std::shared_ptr<PreparedScene> RasterResources::scene(const ScenePtr& scene) {
    return scenes_.get(scene, [&] { return std::make_shared<PreparedScene>(scene); });
}

std::shared_ptr<PreparedScene> RasterResources::sceneFor(const RenderRequest& request) {
    auto prepared = scene(request.scene);
    if (drawsEdges(request.style, request.output)) uploadEdges(prepared->gpu);
    return prepared;
}

std::shared_ptr<const SampledTarget> RasterResources::sampledTarget(glm::ivec2 sizePx, TargetFormat format,
                                                                    int samples) {
    return targets_.get({sizePx, format, samples},
                        [&] { return std::make_shared<const SampledTarget>(sizePx, format, samples); });
}

std::shared_ptr<const FrameTarget> RasterResources::frameTarget(glm::ivec2 sizePx, TargetFormat format) {
    return frameTargets_.get({sizePx, format, 1},
                             [&] { return std::make_shared<const FrameTarget>(sizePx, format, 1); });
}

std::shared_ptr<const BlendedTarget> RasterResources::blendedTarget(const RenderRequest& request,
                                                                    const Display& display) {
    std::shared_ptr<const GpuBlend> maps;
    if (display.blend && request.output == OutputKind::color)
        maps = blends_.get(display.blend, [&] {
            return std::make_shared<const GpuBlend>(uploadBlend(*display.blend, display.sizePx));
        });
    const TargetFormat format{request.output, request.linearOutput};
    return blendedTargets_.get({display.sizePx, format, maps}, [&] {
        return std::make_shared<const BlendedTarget>(display.sizePx, format, maps);
    });
}

std::shared_ptr<const ScenePrograms> programsFor(PreparedScene& scene, SceneLook look,
                                                 const GeometryPath& path) {
    return scene.programs.get({look.style, look.output, path}, [&] {
        return std::make_shared<const ScenePrograms>(*scene.gpu.scene, look, path);
    });
}

std::shared_ptr<const StrokePrograms> strokeProgramsFor(PreparedScene& scene, SceneLook look, bool holes) {
    return scene.strokePrograms.get({look.style, look.output, holes}, [&] {
        return std::make_shared<const StrokePrograms>(*scene.gpu.scene, look, holes);
    });
}

void waitForGpu() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    constexpr GLuint64 kOneSecondNs = 1'000'000'000;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
        status = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kOneSecondNs);
    glDeleteSync(fence);
    if (status == GL_WAIT_FAILED) throw std::runtime_error("OpenGL failed in the middle of a frame");
}

double mebibytes(size_t bytes) { return static_cast<double>(bytes) / (1024.0 * 1024.0); }

void describe(const PreparedScene& scene, const ScenePrograms& programs, RenderStats& stats) {
    stats.meshlets = meshletCountOf(scene.gpu);
    stats.attributes = programs.attributes();
    stats.gpuMemoryMib.scene = mebibytes(memoryBytesOf(scene.gpu));
}

void describeMemory(size_t displayBytes, size_t pictureBytes, const BlendedTarget& blended,
                    RenderStats& stats) {
    stats.gpuMemoryMib.display = mebibytes(displayBytes + blended.mapBytes());
    stats.gpuMemoryMib.pictures = mebibytes(pictureBytes + blended.memoryBytes());
}

GeometricError errorOf(const Certificate& certificate) {
    return {certificate.maxPx, certificate.p99Px, certificate.meanPx};
}

}  // namespace curvewall
