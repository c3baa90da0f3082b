// How coverage finds the nodes of the piece tree for a meshlet: by a walk, or in a grid. Frames of coverage
// alone turn the camera once around: GPU milliseconds a frame of each level, the share of meshlets that the
// first leaves out, and how many nodes lie in the range of the others. See docs/coverage.md.

#include "calibration/pieces/piece_fit.h"
#include "renderer/coverage.h"
#include "renderer/gl/egl_context.h"
#include "renderer/gl/stage_timer.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/sample_paths.h"
#include "tests/support/shipped_walls.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr int kFrames = 12;
constexpr int kTurns = 5;

const Display& displayNamed(const std::string& name) {
    static std::map<std::string, Wall> walls;
    if (!walls.contains(name)) walls[name] = test::shippedWall(name);
    return walls[name].displays[0];
}

const PieceMesh& piecesOf(const std::string& name, double tolerancePx) {
    static std::map<std::pair<std::string, double>, PieceMesh> meshes;
    PieceMesh& mesh = meshes[{name, tolerancePx}];
    if (mesh.pieces.empty()) mesh = fitPieces(displayNamed(name), tolerancePx).mesh;
    return mesh;
}

ScenePtr sceneNamed(const std::string& name) {
    static std::map<std::string, ScenePtr> scenes;
    ScenePtr& scene = scenes[name];
    if (!scene) scene = std::make_shared<const Scene>(loadScene(name));
    return scene;
}

struct NodeCounts {
    double meshlets = 0, seen = 0, nodes = 0;

    void add(const Coverage& coverage, const ScenePart& part) {
        std::vector<glm::uvec2> ranges(part.meshletCount);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(coverage.meshletNodes().id(), 0,
                                static_cast<GLsizeiptr>(ranges.size() * sizeof ranges[0]), ranges.data());
        for (const glm::uvec2 range : ranges) {
            meshlets += 1;
            seen += range.x < range.y ? 1 : 0;
            nodes += range.y - range.x;
        }
    }
};

// Milliseconds of each level in each frame of a turn, the least of all turns: other work on the machine only
// adds to it.
class LeastTimes {
public:
    double add(size_t frame, const std::vector<StageTime>& times) {
        double sum = 0;
        for (const StageTime& time : times) {
            double& least = ms_[time.stage].try_emplace(frame, time.ms).first->second;
            least = std::min(least, time.ms);
            sum += time.ms;
        }
        return sum;
    }

    double meanMs(std::string_view stage) const {
        double sum = 0;
        for (const auto& [frame, ms] : ms_.at(stage)) sum += ms;
        return sum / static_cast<double>(ms_.at(stage).size());
    }

private:
    std::map<std::string_view, std::map<size_t, double>> ms_;
};

void findPairs(benchmark::State& state, const std::string& display, double tolerancePx,
               const std::string& sceneName, MeshletLookup lookup) {
    const EglContext context;
    const GpuScene scene = uploadScene(sceneNamed(sceneName));
    const GpuPieces pieces = uploadPieces(piecesOf(display, tolerancePx));
    Coverage coverage(scene.chunks, ~0u, lookup);
    StageTimer timer;
    NodeCounts counts;
    LeastTimes least;
    uint64_t pairs = 0;
    size_t frame = 0;
    for (auto _ : state) {
        Camera camera = scene.scene->defaultCamera;
        camera.orientation.yawRad += 2 * std::numbers::pi * static_cast<double>(frame) / kFrames;
        const SceneView view = sceneViewOf(camera, glm::dvec3(0), *scene.scene);
        coverage.beginFrame();
        for (size_t i = 0; i < coverage.parts().size(); ++i) {
            coverage.findPairs(i, pieces, view, sampleGridOf(pieces, {}), &timer);
            timer.end();
            counts.add(coverage, coverage.parts()[i]);
        }
        glFinish();
        state.SetIterationTime(least.add(frame, timer.take()) / 1000);
        pairs += coverage.finishFrame().pairCount;
        frame = (frame + 1) % kFrames;
    }
    state.counters["pieces"] = pieces.pieceCount;
    state.counters["meshlets_ms"] = least.meanMs("meshlets");
    state.counters["triangles_ms"] = least.meanMs("triangles");
    state.counters["culled"] = 1 - counts.seen / counts.meshlets;
    state.counters["node_range"] = counts.nodes / counts.seen;
    state.counters["pairs"] = static_cast<double>(pairs) / static_cast<double>(state.iterations());
}

bool registerAll() {
    const std::vector<std::pair<std::string, double>> displays{
        {"camera-texture", 0.5}, {"camera-texture", 0.1}, {"view-deformation", 0.5},
        {"sphere-slices", 0.5},  {"full-cylinder", 0.25}, {"dome-master", 0.5}};
    std::vector<std::string> scenes{"city:35000", "city:500000"};
    for (const char* file : {"dutch_ship/dutch_ship_medium_1k.gltf", "kenney_city/kenney_city.glb"}) {
        const std::filesystem::path path = test::scenesFolder() / file;
        if (std::filesystem::exists(path)) scenes.push_back(path.string());
    }
    for (const auto& [display, tolerancePx] : displays)
        for (const std::string& scene : scenes)
            for (const MeshletLookup lookup : {MeshletLookup::tree, MeshletLookup::grid}) {
                const std::string name = "lookup/" + display + "/" +
                                         std::to_string(tolerancePx).substr(0, 3) + "px/" +
                                         std::filesystem::path(scene).filename().string() +
                                         (lookup == MeshletLookup::tree ? "/tree" : "/grid");
                benchmark::RegisterBenchmark(name.c_str(), findPairs, display, tolerancePx, scene, lookup)
                    ->UseManualTime()
                    ->Iterations(kTurns * kFrames)
                    ->Unit(benchmark::kMillisecond);
            }
    return true;
}

const bool kRegistered = registerAll();

}  // namespace
}  // namespace curvewall
