#include "cli/blend_mask_files.h"

#include "calibration/files/map_file.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <utility>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string relativeToWall(const fs::path& path, const std::string& wallPath) {
    const fs::path folder = fs::absolute(wallPath).parent_path();
    return fs::absolute(path).lexically_normal().lexically_proximate(folder.lexically_normal()).string();
}

json blendLine(const BlendMaskFiles::Entry& entry) { return {{"alpha", entry.pathForWall}}; }

}  // namespace

BlendMaskFiles writeBlendMasks(const Wall& wall, const std::string& wallPath, const std::string& folder) {
    BlendMasks masks = makeBlendMasks(wall);
    BlendMaskFiles files{{}, masks.sum};
    for (size_t i = 0; i < wall.displays.size(); ++i) {
        const Display& display = wall.displays[i];
        const std::string path = (fs::path(folder) / (display.name + "-alpha.png")).string();
        writePng16(path, {display.sizePx, 1, true, std::move(masks.displays[i].values)});
        files.entries.push_back(
            {display.name, path, relativeToWall(path, wallPath), masks.displays[i].overlapShare});
    }
    return files;
}

json toJson(const BlendMaskFiles& files) {
    json displays = json::array();
    for (const auto& entry : files.entries)
        displays.push_back({{"name", entry.display},
                            {"file", entry.path},
                            {"overlap_share", entry.overlapShare},
                            {"blend", blendLine(entry)}});
    return {{"displays", displays},
            {"sum_deviation",
             {{"max", files.sum.largestDeviation},
              {"max_at",
               {{"display", files.entries[files.sum.display].display},
                {"pixel", {files.sum.pixel.x, files.sum.pixel.y}}}},
              {"share_above_1_percent", files.sum.shareOff}}}};
}

void printReport(const BlendMaskFiles& files) {
    fmt::print("blend masks, 16-bit and linear:\n");
    for (const auto& entry : files.entries)
        fmt::print("  {}: {:.1f} % of it overlaps -> {}\n    \"blend\": {}\n", entry.display,
                   100 * entry.overlapShare, entry.path, blendLine(entry).dump());
    fmt::print(
        "  the masks on a ray sum to 1 within {:.5f} (at {}, {} of {}); {:.4f} % of all pixels are off by "
        "more than 1 %\n",
        files.sum.largestDeviation, files.sum.pixel.x, files.sum.pixel.y,
        files.entries[files.sum.display].display, 100 * files.sum.shareOff);
}

}  // namespace curvewall
