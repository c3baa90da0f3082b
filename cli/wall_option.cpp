#include "cli/wall_option.h"

#include "calibration/errors.h"
#include "calibration/readers/projection_fields.h"
#include "calibration/readers/wall_reader.h"

#include <spdlog/spdlog.h>

#include <charconv>
#include <optional>

namespace curvewall {
namespace {

std::optional<glm::ivec2> sizeFromText(const std::string& text) {
    if (text.empty()) return std::nullopt;
    const char* const end = text.data() + text.size();
    glm::ivec2 sizePx(0);
    const auto [cross, widthError] = std::from_chars(text.data(), end, sizePx.x);
    if (widthError == std::errc() && cross != end && *cross == 'x') {
        const auto [rest, heightError] = std::from_chars(cross + 1, end, sizePx.y);
        if (heightError == std::errc() && rest == end && sizePx.x >= 1 && sizePx.x <= kMostPx &&
            sizePx.y >= 1 && sizePx.y <= kMostPx)
            return sizePx;
    }
    throw UsageError("--size: expected WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(kMostPx) +
                     ", found \"" + text + "\"");
}

}  // namespace

void addWallOption(CLI::App& subcommand, WallOption& wall) {
    subcommand.add_option("WALL", wall.path, "Wall file, or a calibration of another program")->required();
    subcommand.add_option("--size", wall.size,
                          "WIDTHxHEIGHT of a calibration that names no resolution, pixels");
}

Wall readWall(const WallOption& wall) { return readWall(wall.path, sizeFromText(wall.size)); }

void logWarnings(const Wall& wall) {
    for (const Display& display : wall.displays)
        for (const std::string& warning : display.warnings) spdlog::warn("{}: {}", display.name, warning);
}

}  // namespace curvewall
