#pragma once
// A scene on the GPU with all that is made for it and kept between renders, so that it goes as one.

#include "calibration/pieces/piece_fit.h"
#include "renderer/piecewise.h"
#include "renderer/prepared_images.h"
#include "renderer/recently_used.h"
#include "renderer/vertex_warp.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

// The pieces of one display on the GPU.
struct PreparedPieces {
    GpuPieces gpu;
    std::shared_ptr<const FittedPieces> fitted;
    std::shared_ptr<const GpuOwners> owners;   // refits share them
    std::optional<StrokePieces> forStrokes{};  // where a scene has had some
};

// A renderer with what it refers to.
struct PreparedDraw {
    std::shared_ptr<const GpuOwners> sampleOwners;  // large
    PiecewiseRenderer renderer;
};

struct DrawKey {
    std::shared_ptr<PreparedPieces> pieces;
    Engine engine;
    Style style;
    OutputKind output;
    int samples;
    bool operator==(const DrawKey&) const = default;
};

struct ImageKey {
    std::shared_ptr<const PreparedSource> source;
    Style style;
    OutputKind output;
    bool operator==(const ImageKey&) const = default;
};

// A renderer with what it refers to.
struct PreparedWarp {
    std::shared_ptr<const GpuWarp> warp;
    std::shared_ptr<SceneParts> parts;
    VertexWarpRenderer renderer;
};

struct WarpDrawKey {
    std::shared_ptr<const GpuWarp> warp;
    Style style;
    OutputKind output;
    bool operator==(const WarpDrawKey&) const = default;
};

struct ProgramsKey {
    Style style;
    OutputKind output;
    GeometryPath path;
    bool operator==(const ProgramsKey&) const = default;
};

struct StrokesKey {
    Style style;
    OutputKind output;
    bool holes;
    bool operator==(const StrokesKey&) const = default;
};

struct PreparedScene {
    explicit PreparedScene(const ScenePtr& scene) : gpu(uploadScene(scene)) {}

    SceneReplicators& replicatorsFor(Engine engine) {
        const auto [found, isNew] = replicators.try_emplace(engine);
        if (isNew) found->second = makeReplicators(engine, gpu);
        return found->second;
    }

    GpuScene gpu;
    std::map<Engine, SceneReplicators> replicators;
    RecentlyUsed<DrawKey, PreparedDraw> draws{16};
    RecentlyUsed<ImageKey, ImageBasedRenderer> images{8};
    RecentlyUsed<std::vector<std::string>, SceneParts> parts{4};  // by what displays' maps are
    RecentlyUsed<WarpDrawKey, PreparedWarp> warps{8};
    RecentlyUsed<ProgramsKey, const ScenePrograms> programs{16};
    RecentlyUsed<StrokesKey, const StrokePrograms> strokePrograms{8};
};

}  // namespace curvewall
