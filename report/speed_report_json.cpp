#include "report/speed_report_json.h"

#include "calibration/files/json_file.h"
#include "report/text_file.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace curvewall {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;
constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
constexpr int64_t kMostPixels = int64_t{1} << 53;  // as far as whole numbers of JSON are exact everywhere
constexpr int kMostInt = std::numeric_limits<int>::max();

json orNull(double value) { return std::isinf(value) ? json() : json(value); }

double numberOf(JsonFields& fields, const char* key) {
    return fields.required(key, fields.number(key, kAnyNumber));
}

double decibelsOf(JsonFields& fields, const char* key) {
    return fields.required(key, fields.numberOrInfinity(key, kAnyNumber));
}

int intOf(JsonFields& fields, const char* key) {
    return static_cast<int>(fields.required(key, fields.wholeNumber(key, 0, kMostInt)));
}

uint64_t countOf(JsonFields& fields, const char* key) {
    return static_cast<uint64_t>(fields.required(key, fields.wholeNumber(key, 0, kMostPixels)));
}

std::string textOf(JsonFields& fields, const char* key) { return fields.required(key, fields.text(key)); }

JsonFields objectOf(JsonFields& fields, const char* key) { return fields.required(key, fields.object(key)); }

glm::ivec2 pairOf(JsonFields& fields, const char* key) {
    const auto pair = fields.required(key, fields.wholeNumbers(key, 2, 0, kMostInt));
    return {static_cast<int>(pair[0]), static_cast<int>(pair[1])};
}

// Lists without an entry are not written.
template <class Value>
std::vector<Value> listOf(JsonFields& fields, const char* key, Value (*read)(JsonFields)) {
    std::vector<Value> values;
    if (fields.has(key))
        for (JsonFields& entry : fields.objects(key)) values.push_back(read(std::move(entry)));
    return values;
}

template <class Value>
void putList(json& object, const char* key, const std::vector<Value>& values) {
    for (const Value& value : values) object[key].push_back(toJson(value));
}

json toJson(const Certificate& error) {
    return {{"max", error.maxPx},         {"p99", error.p99Px},
            {"mean", error.meanPx},       {"max_at", {error.maxAt.x, error.maxAt.y}},
            {"every", error.every},       {"uncovered_pixels", error.uncoveredPixels},
            {"empty_pixels", error.holes}};
}

Certificate certificateFrom(JsonFields fields) {
    Certificate error;
    error.maxPx = numberOf(fields, "max");
    error.p99Px = numberOf(fields, "p99");
    error.meanPx = numberOf(fields, "mean");
    error.maxAt = pairOf(fields, "max_at");
    error.every = intOf(fields, "every");
    error.uncoveredPixels = intOf(fields, "uncovered_pixels");
    error.holes = intOf(fields, "empty_pixels");
    fields.refuseUnknownKeys();
    return error;
}

ImageDifference imageDifferenceFrom(JsonFields fields) {
    ImageDifference image;
    image.shareOff = numberOf(fields, "share_off");
    image.psnrDb = decibelsOf(fields, "psnr_db");
    image.ssim = numberOf(fields, "ssim");
    image.maxDifference = intOf(fields, "max_difference");
    fields.refuseUnknownKeys();
    return image;
}

CoverageError coverageFrom(JsonFields fields) {
    CoverageError coverage;
    coverage.uncoveredPixels = countOf(fields, "uncovered_pixels");
    coverage.overdrawnPixels = countOf(fields, "overdrawn_pixels");
    coverage.twiceCoveredPixels = countOf(fields, "twice_covered_pixels");
    fields.refuseUnknownKeys();
    return coverage;
}

Spread spreadFrom(JsonFields fields) {
    Spread spread;
    spread.median = numberOf(fields, "median");
    spread.min = numberOf(fields, "min");
    spread.max = numberOf(fields, "max");
    fields.refuseUnknownKeys();
    return spread;
}

}  // namespace

json toJson(const MethodErrors& errors) {
    return {{"geometric_px", toJson(errors.geometric)},
            {"misplaced_pixels", errors.misplacedPixels},
            {"image",
             {{"share_off", errors.image.shareOff},
              {"psnr_db", orNull(errors.image.psnrDb)},
              {"ssim", errors.image.ssim},
              {"max_difference", errors.image.maxDifference}}},
            {"coverage",
             {{"uncovered_pixels", errors.coverage.uncoveredPixels},
              {"overdrawn_pixels", errors.coverage.overdrawnPixels},
              {"twice_covered_pixels", errors.coverage.twiceCoveredPixels}}},
            {"supersampled_psnr_db", orNull(errors.supersampledPsnrDb)},
            {"nan_texels", errors.nanTexels}};
}

json toJson(const Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

json toJson(const TruthFacts& truth) {
    return {{"supersamples", truth.supersamples},
            {"noise_db", orNull(truth.noiseDb)},
            {"picture", truth.picture},
            {"crop", truth.crop}};
}

json toJson(const SamplingFloor& floor) {
    return {{"samples", floor.samples},
            {"share_off", floor.shareOff},
            {"psnr_db", orNull(floor.psnrDb)},
            {"supersampled_psnr_db", orNull(floor.supersampledPsnrDb)}};
}

json toJson(const SettingResult& result) {
    json object = {{"method", result.setting.method},
                   {"variant", result.setting.variant},
                   {"knob", result.setting.knob},
                   {"value", result.setting.value},
                   {"samples", result.setting.samples}};
    if (!result.refusal.empty()) {
        object["refusal"] = result.refusal;
        return object;
    }
    object["errors"] = toJson(result.errors);
    object["frame_ms"] = toJson(result.frameMs);
    if (result.stats.is_object()) object["stats"] = result.stats;
    object["crop"] = result.crop;
    object["error_map"] = result.errorMap;
    return object;
}

json toJson(const ViewReport& view) {
    json object = {{"wall", view.wall},
                   {"display", view.display},
                   {"scene", view.scene},
                   {"size", {view.sizePx.x, view.sizePx.y}},
                   {"projection", view.projection},
                   {"truth", toJson(view.truth)}};
    putList(object, "floors", view.floors);
    putList(object, "settings", view.settings);
    return object;
}

json toJson(const SpeedReport& report) {
    json object = {{"version", kVersion},
                   {"gl_renderer", report.glRenderer},
                   {"processor", report.processor},
                   {"tolerance_px", report.tolerancePx}};
    putList(object, "views", report.views);
    return object;
}

MethodErrors methodErrorsFrom(JsonFields fields) {
    MethodErrors errors;
    errors.geometric = certificateFrom(objectOf(fields, "geometric_px"));
    errors.misplacedPixels = countOf(fields, "misplaced_pixels");
    errors.image = imageDifferenceFrom(objectOf(fields, "image"));
    errors.coverage = coverageFrom(objectOf(fields, "coverage"));
    errors.supersampledPsnrDb = decibelsOf(fields, "supersampled_psnr_db");
    errors.nanTexels = countOf(fields, "nan_texels");
    fields.refuseUnknownKeys();
    return errors;
}

TruthFacts truthFactsFrom(JsonFields fields) {
    TruthFacts truth;
    truth.supersamples = intOf(fields, "supersamples");
    truth.noiseDb = decibelsOf(fields, "noise_db");
    truth.picture = textOf(fields, "picture");
    truth.crop = textOf(fields, "crop");
    fields.refuseUnknownKeys();
    return truth;
}

SamplingFloor samplingFloorFrom(JsonFields fields) {
    SamplingFloor floor;
    floor.samples = intOf(fields, "samples");
    floor.shareOff = numberOf(fields, "share_off");
    floor.psnrDb = decibelsOf(fields, "psnr_db");
    floor.supersampledPsnrDb = decibelsOf(fields, "supersampled_psnr_db");
    fields.refuseUnknownKeys();
    return floor;
}

SettingResult settingResultFrom(JsonFields fields) {
    SettingResult result;
    result.setting.method = textOf(fields, "method");
    result.setting.variant = textOf(fields, "variant");
    result.setting.knob = textOf(fields, "knob");
    result.setting.value = numberOf(fields, "value");
    result.setting.samples = intOf(fields, "samples");
    result.refusal = fields.text("refusal").value_or("");
    if (result.refusal.empty()) {
        result.errors = methodErrorsFrom(objectOf(fields, "errors"));
        result.frameMs = spreadFrom(objectOf(fields, "frame_ms"));
        if (auto stats = fields.anyObject("stats")) result.stats = std::move(*stats);
        result.crop = textOf(fields, "crop");
        result.errorMap = textOf(fields, "error_map");
    }
    fields.refuseUnknownKeys();
    return result;
}

ViewReport viewReportFrom(JsonFields fields) {
    ViewReport view;
    view.wall = textOf(fields, "wall");
    view.display = textOf(fields, "display");
    view.scene = textOf(fields, "scene");
    view.sizePx = pairOf(fields, "size");
    view.projection = textOf(fields, "projection");
    view.truth = truthFactsFrom(objectOf(fields, "truth"));
    view.floors = listOf(fields, "floors", samplingFloorFrom);
    view.settings = listOf(fields, "settings", settingResultFrom);
    fields.refuseUnknownKeys();
    return view;
}

SpeedReport speedReportFrom(JsonFields fields) {
    SpeedReport report;
    fields.required("version", fields.wholeNumber("version", kVersion, kVersion));
    report.glRenderer = textOf(fields, "gl_renderer");
    report.processor = textOf(fields, "processor");
    report.tolerancePx = numberOf(fields, "tolerance_px");
    report.views = listOf(fields, "views", viewReportFrom);
    fields.refuseUnknownKeys();
    return report;
}

SpeedReport readSpeedReport(const std::string& path) {
    return readJsonFile(path, "a report that this program wrote", speedReportFrom);
}

void writeSpeedReport(const SpeedReport& report, const std::string& path) {
    writeTextFile(path, toJson(report).dump(2) + "\n");
}

}  // namespace curvewall
