#pragma once
// What a render did and what it cost, as `--stats` and the Curvewall-Stats header report it.

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

struct GeometricError {
    double maxPx = 0;
    double p99Px = 0;
    double meanPx = 0;
};

struct StageMs {
    std::string stage;
    double ms = 0;
};

// What a frame needs on the GPU.
struct GpuMemoryMib {
    double scene = 0;     // with its textures
    double pairs = 0;     // what finds the pairs
    double display = 0;   // what the display is drawn by: pieces, owners, rays, tables
    double pictures = 0;  // all that is drawn into
};

// Why this method, where that was left open.
struct ChoiceStats {
    struct Forecast {
        std::string settings;
        double errorPx = 0;
        double frameMs = 0;
        std::optional<double> trialMs{};
    };
    std::string why;
    std::vector<Forecast> forecasts;    // the one chosen first
    std::vector<std::string> ruledOut;  // "METHOD: why"
};

struct RenderStats {
    std::string method;
    std::string engine;  // as asked for, or "plain" (one piece: one plain draw), "cube", "planar", "vertex",
                         // "embree"
    double tolerancePx = 0;  // piecewise
    GeometricError geometricError;
    int pieces = 0;
    int certificateEvery = 1;         // piecewise: the error is over every so many-th row and column
    double fullCertificateAgeMs = 0;  // piecewise: since the display was last certified at every pixel
    double tessellationPx = 0;        // vertex-warp
    std::string source, filter, facePass, lookup;  // image-based, as are the next seven
    int faceSizePx = 0;
    int faces = 0;                        // cube faces that the display sees, or the one planar picture
    uint64_t sourceTexels = 0;            // of all faces
    int levels = 0;                       // of halved faces
    int meshStepPx = 0;                   // where the lookup is a mesh, as is the next
    GeometricError lookupError;           // of the places alone
    std::string bounds;                   // bounded-raycast, as are the next two, of frame 0
    uint64_t coveredFragments = 0;        // of bounding shapes
    uint64_t renderedFragments = 0;       // of those, where a ray meets the triangle
    uint64_t triangles = 0;               // in the scene
    uint64_t pairs = 0;                   // (triangle, piece) pairs drawn in frame 0
    uint64_t meshlets = 0;                // of the scene's surfaces
    uint64_t meshletsDrawn = 0;           // in frame 0, where the engine looks at them
    std::vector<std::string> attributes;  // that shaders fetch: position, normal, uv, texture, edges
    int samples = 1;
    int frames = 1;
    double frameMsMedian = 0;
    double frameMsMin = 0;
    double frameMsMax = 0;
    std::vector<StageMs> stageMs;  // on the GPU, medians over the frames
    double prepareMs = 0;          // fitting, certifying, upload, compilation: once, outside the frames
    std::string glRenderer;        // empty for the reference
    double peakMemoryMib = 0;
    GpuMemoryMib gpuMemoryMib{};

    std::optional<ChoiceStats> choice{};
    double overdraw() const {
        return renderedFragments == 0
                   ? 0
                   : static_cast<double>(coveredFragments) / static_cast<double>(renderedFragments) - 1;
    }

    double replicationRatio() const {
        return triangles == 0 ? 0 : static_cast<double>(pairs) / static_cast<double>(triangles);
    }
};

// Keys as in docs/command-line.md.
nlohmann::json toJson(const RenderStats& stats);

}  // namespace curvewall
