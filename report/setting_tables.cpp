#include "report/setting_tables.h"

#include "report/recommendation.h"
#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace curvewall {
namespace {

constexpr const char* kNone = "–";

double numberAt(const nlohmann::json& object, const std::string& key) {
    if (!object.is_object()) return 0;
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

std::string countAt(const nlohmann::json& object, const std::string& key) {
    const double count = numberAt(object, key);
    return count > 0 ? countText(static_cast<uint64_t>(count)) : kNone;
}

std::string measureOr(double value) { return value > 0 ? measureText(value) : kNone; }

double gpuMemoryMib(const SettingResult& result) {
    if (!result.stats.is_object() || !result.stats.contains("gpu_memory_mib")) return 0;
    const nlohmann::json& memory = result.stats["gpu_memory_mib"];
    double sum = 0;
    for (const char* part : {"scene", "pairs", "display", "pictures"}) sum += numberAt(memory, part);
    return sum;
}

std::string spreadText(const Spread& ms) {
    return fmt::format("{} to {}", measureText(ms.min), measureText(ms.max));
}

// The methods' name, and whatever sets it apart from the method's others.
std::string rowName(const SettingName& setting) { return "`" + setting.text() + "`"; }

}  // namespace

std::string madeOfText(const SettingResult& result) {
    const auto counted = [&](const char* key, const char* one, const char* many) {
        const double count = numberAt(result.stats, key);
        return countAt(result.stats, key) + " " + (count == 1 ? one : many);
    };
    const std::string& method = result.setting.method;
    if (method == "piecewise" && numberAt(result.stats, "pieces") > 0)
        return counted("pieces", "piece", "pieces");
    if (method == "image-based" && numberAt(result.stats, "faces") > 0)
        return counted("faces", "face", "faces");
    if (method == "vertex-warp" && numberAt(result.stats, "pairs") > 0)
        return counted("pairs", "part", "parts");
    return kNone;
}

Table settingsTable(const ViewReport& view, const SettingResult* best) {
    Table table{{"setting", "ms", "ms, rounds", "largest error, px", "99 in 100, px", "wrong pixels, %",
                 "wrong edges, %", "PSNR, dB", "SSIM", "wrongly covered", "misplaced",
                 fmt::format("PSNR of {} rays, dB", view.truth.supersamples), "made of", "pairs",
                 "overdraw, %", "on the GPU, MiB"},
                {}};
    for (const SettingResult& result : view.settings) {
        if (!result.refusal.empty()) continue;
        if (&result == best) table.emphasized.push_back(table.rows.size());
        const MethodErrors& errors = result.errors;
        table.rows.push_back(
            {rowName(result.setting), measureText(result.frameMs.median), spreadText(result.frameMs),
             measureText(errors.geometric.maxPx), measureText(errors.geometric.p99Px),
             percentText(errors.image.shareOff), result.edges ? percentText(result.edges->shareOff) : kNone,
             decibelText(errors.image.psnrDb), fmt::format("{:.4f}", errors.image.ssim),
             countText(coverageFaults(result)), countText(errors.misplacedPixels),
             decibelText(errors.supersampledPsnrDb), madeOfText(result), countAt(result.stats, "pairs"),
             measureOr(100 * numberAt(result.stats, "overdraw")), measureOr(gpuMemoryMib(result))});
    }
    return table;
}

Table stagesTable(const ViewReport& view) {
    Table table{{"setting"}, {}};
    const auto stagesOf = [](const SettingResult& result) {
        return result.refusal.empty() && result.stats.is_object()
                   ? result.stats.value("stage_ms", nlohmann::json::object())
                   : nlohmann::json::object();
    };
    for (const SettingResult& result : view.settings) {
        const nlohmann::json stages = stagesOf(result);
        for (const auto& [stage, ms] : stages.items())
            if (std::ranges::find(table.columns, stage) == table.columns.end())
                table.columns.push_back(stage);
    }
    for (const SettingResult& result : view.settings) {
        const nlohmann::json stages = stagesOf(result);
        if (stages.empty()) continue;
        std::vector<std::string> row{rowName(result.setting)};
        for (size_t i = 1; i < table.columns.size(); ++i)
            row.push_back(stages.contains(table.columns[i]) ? measureText(numberAt(stages, table.columns[i]))
                                                            : kNone);
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace curvewall
