#include "renderer/stats.h"

#include <nlohmann/json.hpp>

namespace curvewall {
namespace {

nlohmann::json toJson(const ChoiceStats& choice) {
    nlohmann::json json = {{"why", choice.why}, {"ruled_out", choice.ruledOut}};
    for (const auto& [settings, errorPx, frameMs, trialMs] : choice.forecasts) {
        nlohmann::json& forecast = json["forecasts"].emplace_back();
        forecast = {{"settings", settings}, {"error_px", errorPx}, {"frame_ms", frameMs}};
        if (trialMs) forecast["trial_ms"] = *trialMs;
    }
    return json;
}

}  // namespace

namespace {

nlohmann::json toJson(const GeometricError& error) {
    return {{"max", error.maxPx}, {"p99", error.p99Px}, {"mean", error.meanPx}};
}

}  // namespace

nlohmann::json toJson(const RenderStats& stats) {
    nlohmann::json json = {
        {"method", stats.method},
        {"engine", stats.engine},
        {"tolerance_px", stats.tolerancePx},
        {"geometric_error_px", toJson(stats.geometricError)},
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
    if (const GpuMemoryMib& memory = stats.gpuMemoryMib; memory.scene > 0)
        json["gpu_memory_mib"] = {{"scene", memory.scene},
                                  {"pairs", memory.pairs},
                                  {"display", memory.display},
                                  {"pictures", memory.pictures}};
    if (stats.method == "piecewise")
        json["certificate"] = {{"every", stats.certificateEvery},
                               {"full_age_ms", stats.fullCertificateAgeMs}};
    if (stats.method == "image-based") {
        json["source"] = stats.source;
        json["filter"] = stats.filter;
        json["face_pass"] = stats.facePass;
        json["lookup"] = stats.lookup;
        json["source_texels"] = stats.sourceTexels;
        json["levels"] = stats.levels;
        if (stats.meshStepPx > 0) {
            json["mesh_step_px"] = stats.meshStepPx;
            json["lookup_error_px"] = toJson(stats.lookupError);
        }
    }
    if (stats.method == "bounded-raycast") {
        json["bounds"] = stats.bounds;
        json["covered_fragments"] = stats.coveredFragments;
        json["rendered_fragments"] = stats.renderedFragments;
        json["overdraw"] = stats.overdraw();
    }
    if (stats.method == "vertex-warp") json["tessellation_px"] = stats.tessellationPx;
    if (stats.choice) json["auto"] = toJson(*stats.choice);
    return json;
}

}  // namespace curvewall
