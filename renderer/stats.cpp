#include "renderer/stats.h"

#include <nlohmann/json.hpp>

namespace curvewall {

nlohmann::json toJson(const RenderStats& stats) {
    nlohmann::json json = {
        {"method", stats.method},
        {"engine", stats.engine},
        {"tolerance_px", stats.tolerancePx},
        {"geometric_error_px",
         {{"max", stats.geometricError.maxPx},
          {"p99", stats.geometricError.p99Px},
          {"mean", stats.geometricError.meanPx}}},
        {"pieces", stats.pieces},
        {"face_size_px", stats.faceSizePx},
        {"faces", stats.faces},
        {"triangles", stats.triangles},
        {"pairs", stats.pairs},
        {"replication_ratio", stats.replicationRatio()},
        {"meshlets", stats.meshlets},
        {"meshlets_drawn", stats.meshletsDrawn},
        {"attributes", stats.attributes},
        {"samples", stats.samples},
        {"frames", stats.frames},
        {"frame_ms", {{"median", stats.frameMsMedian}, {"min", stats.frameMsMin}, {"max", stats.frameMsMax}}},
        {"prepare_ms", stats.prepareMs},
        {"gl_renderer", stats.glRenderer},
        {"peak_memory_mib", stats.peakMemoryMib}};
    for (const auto& [stage, ms] : stats.stageMs) json["stage_ms"][stage] = ms;
    if (stats.sceneMemoryMib > 0)
        json["gpu_memory_mib"] = {{"scene", stats.sceneMemoryMib}, {"pairs", stats.pairsMemoryMib}};
    if (stats.method == "piecewise")
        json["certificate"] = {{"every", stats.certificateEvery},
                               {"full_age_ms", stats.fullCertificateAgeMs}};
    if (stats.method == "image-based") {
        json["source"] = stats.source;
        json["filter"] = stats.filter;
    }
    if (stats.method == "vertex-warp") json["tessellation_px"] = stats.tessellationPx;
    return json;
}

}  // namespace curvewall
