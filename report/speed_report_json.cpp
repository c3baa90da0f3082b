#include "report/speed_report_json.h"

#include "report/kept_json.h"

namespace curvewall {

using nlohmann::json;

void to_json(json& out, const Spread& spread) {
    out = {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

void from_json(const json& in, Spread& spread) { spread = {in.at("median"), in.at("min"), in.at("max")}; }

void to_json(json& out, const SettingName& setting) {
    out = {{"method", setting.method},
           {"variant", setting.variant},
           {"knob", setting.knob},
           {"value", setting.value},
           {"samples", setting.samples}};
}

void from_json(const json& in, SettingName& setting) {
    setting = {in.at("method"), in.at("variant"), in.at("knob"), in.at("value"), in.at("samples")};
}

static void to_json(json& out, const ImageDifference& image) {
    out = {{"share_off", image.shareOff},
           {"psnr_db", image.psnrDb},
           {"ssim", image.ssim},
           {"max_difference", image.maxDifference}};
}

static void from_json(const json& in, ImageDifference& image) {
    image = {in.at("share_off"), numberOrInfinity(in.at("psnr_db")), in.at("ssim"), in.at("max_difference")};
}

void to_json(json& out, const MethodErrors& errors) {
    const Certificate& geometric = errors.geometric;
    const CoverageError& coverage = errors.coverage;
    out = {{"geometric_px",
            {{"max", geometric.maxPx},
             {"p99", geometric.p99Px},
             {"mean", geometric.meanPx},
             {"max_at", {geometric.maxAt.x, geometric.maxAt.y}},
             {"empty_pixels", geometric.holes},
             {"misplaced_pixels", errors.misplacedPixels}}},
           {"image", errors.image},
           {"nan_texels", errors.nanTexels},
           {"coverage",
            {{"uncovered_pixels", coverage.uncoveredPixels},
             {"overdrawn_pixels", coverage.overdrawnPixels},
             {"twice_covered_pixels", coverage.twiceCoveredPixels}}},
           {"supersampled_psnr_db", errors.supersampledPsnrDb}};
}

void from_json(const json& in, MethodErrors& errors) {
    const json& geometric = in.at("geometric_px");
    errors.geometric.maxPx = numberOrInfinity(geometric.at("max"));
    errors.geometric.p99Px = numberOrInfinity(geometric.at("p99"));
    errors.geometric.meanPx = numberOrInfinity(geometric.at("mean"));
    errors.geometric.maxAt = {geometric.at("max_at").at(0), geometric.at("max_at").at(1)};
    errors.geometric.holes = geometric.at("empty_pixels");
    errors.misplacedPixels = geometric.at("misplaced_pixels");
    errors.image = in.at("image");
    errors.nanTexels = in.at("nan_texels");
    const json& coverage = in.at("coverage");
    errors.coverage = {coverage.at("uncovered_pixels"), coverage.at("overdrawn_pixels"),
                       coverage.at("twice_covered_pixels")};
    errors.supersampledPsnrDb = numberOrInfinity(in.at("supersampled_psnr_db"));
}

void to_json(json& out, const SettingResult& result) {
    out = {{"setting", result.setting}};
    if (!result.refusal.empty()) {
        out["refused"] = result.refusal;
        return;
    }
    out["errors"] = result.errors;
    if (result.edges) out["edges"] = *result.edges;
    out["closed_room"] = {{"uncovered_pixels", result.room.uncoveredPixels},
                          {"twice_covered_pixels", result.room.twiceCoveredPixels}};
    out["frame_ms"] = result.frameMs;
    out["stats"] = result.stats;
    if (!result.picture.empty()) out["pictures"]["picture"] = result.picture;
    if (!result.crop.empty()) out["pictures"]["crop"] = result.crop;
    if (!result.errorMap.empty()) out["pictures"]["error_map"] = result.errorMap;
}

void from_json(const json& in, SettingResult& result) {
    result = {};
    result.setting = in.at("setting");
    result.refusal = in.value("refused", "");
    if (!result.refusal.empty()) return;
    result.errors = in.at("errors");
    if (in.contains("edges")) result.edges = in.at("edges").get<ImageDifference>();
    const json& room = in.at("closed_room");
    result.room = {room.at("uncovered_pixels"), room.at("twice_covered_pixels")};
    result.frameMs = in.at("frame_ms");
    result.stats = in.at("stats");
    const json pictures = in.value("pictures", json::object());
    result.picture = pictures.value("picture", "");
    result.crop = pictures.value("crop", "");
    result.errorMap = pictures.value("error_map", "");
}

void to_json(json& out, const TruthFacts& truth) {
    out = {{"rays_a_pixel", truth.supersamples},
           {"noise_db", truth.noiseDb},
           {"picture", truth.picture},
           {"crop", truth.crop}};
}

void from_json(const json& in, TruthFacts& truth) {
    truth = {in.at("rays_a_pixel"), numberOrInfinity(in.at("noise_db")), in.at("picture"), in.at("crop")};
}

void to_json(json& out, const SamplingFloor& floor) {
    out = {{"samples", floor.samples},
           {"share_off", floor.shareOff},
           {"edges_off", floor.edgesOff},
           {"psnr_db", floor.psnrDb},
           {"supersampled_psnr_db", floor.supersampledPsnrDb}};
}

void from_json(const json& in, SamplingFloor& floor) {
    floor = {in.at("samples"), in.at("share_off"), in.at("edges_off"), numberOrInfinity(in.at("psnr_db")),
             numberOrInfinity(in.at("supersampled_psnr_db"))};
}

void to_json(json& out, const ViewReport& view) {
    out = {{"wall", view.wall},
           {"display", view.display},
           {"scene", view.scene},
           {"size", {view.sizePx.x, view.sizePx.y}},
           {"projection", view.projection},
           {"truth", view.truth},
           {"sampling_floors", view.floors},
           {"settings", view.settings}};
}

void to_json(json& out, const SpeedReport& report) {
    out = {{"gl_renderer", report.glRenderer},
           {"processor", report.processor},
           {"tolerance_px", report.tolerancePx},
           {"views", report.views}};
}

}  // namespace curvewall
