#pragma once
// What every raster method needs and keeps between renders: scenes on the GPU, their programs, targets.

#include "renderer/blended_target.h"
#include "renderer/prepared_scene.h"
#include "renderer/recently_used.h"
#include "renderer/render.h"
#include "renderer/replicator.h"
#include "renderer/sampled_target.h"

#include <memory>

namespace curvewall {

class RasterResources {
public:
    // Keeps what belongs to the `mostScenes` scenes used last. Needs a GL context only once it is asked.
    explicit RasterResources(size_t mostScenes) : scenes_(mostScenes) {}

    std::shared_ptr<PreparedScene> scene(const ScenePtr& scene);
    // With the edges that the style draws.
    std::shared_ptr<PreparedScene> sceneFor(const RenderRequest& request);

    std::shared_ptr<const SampledTarget> sampledTarget(glm::ivec2 sizePx, TargetFormat format, int samples);
    // Of one sample.
    std::shared_ptr<const FrameTarget> frameTarget(glm::ivec2 sizePx, TargetFormat format);
    // What the frames of a request end in, with the display's maps where it has any.
    std::shared_ptr<const BlendedTarget> blendedTarget(const RenderRequest& request, const Display& display);

private:
    struct TargetKey {
        glm::ivec2 sizePx;
        TargetFormat format;
        int samples;
        bool operator==(const TargetKey&) const = default;
    };
    struct BlendedTargetKey {
        glm::ivec2 sizePx;
        TargetFormat format;
        std::shared_ptr<const GpuBlend> maps;
        bool operator==(const BlendedTargetKey&) const = default;
    };

    RecentlyUsed<BlendMapsPtr, const GpuBlend> blends_{16};
    RecentlyUsed<TargetKey, const SampledTarget> targets_{2};  // large
    RecentlyUsed<TargetKey, const FrameTarget> frameTargets_{2};
    RecentlyUsed<BlendedTargetKey, const BlendedTarget> blendedTargets_{2};
    RecentlyUsed<ScenePtr, PreparedScene> scenes_;
};

// Programs do not depend on where the pieces are, so that an eye that moves compiles nothing.
std::shared_ptr<const ScenePrograms> programsFor(PreparedScene& scene, SceneLook look,
                                                 const GeometryPath& path);
std::shared_ptr<const StrokePrograms> strokeProgramsFor(PreparedScene& scene, SceneLook look, bool holes);

// Distances, counts and points are those of the pixel's centre: there is no average of them.
inline int samplesFor(const RenderRequest& request) {
    return request.output == OutputKind::color ? request.samples : 1;
}

// Waits until the GPU has done everything recorded so far.
void waitForGpu();

// Records a frame until its buffers had room for it: they grow when the renderer finishes one that
// overflowed.
template <class FrameRenderer, class Record>
FrameOutcome drawUntilItFits(FrameRenderer& renderer, const Record& record) {
    while (true) {
        record();
        waitForGpu();
        const FrameOutcome outcome = renderer.finishFrame();
        if (!outcome.overflowed) return outcome;
    }
}

// What the statistics of every raster method tell.
void describe(const PreparedScene& scene, const ScenePrograms& programs, RenderStats& stats);
// Its memory: what the display is drawn by without blend maps, and what is drawn into before it is blended.
void describeMemory(size_t displayBytes, size_t pictureBytes, const BlendedTarget& blended,
                    RenderStats& stats);
GeometricError errorOf(const Certificate& certificate);
double mebibytes(size_t bytes);

}  // namespace curvewall
