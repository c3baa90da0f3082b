#include "cli/wall_option.h"

#include "calibration/readers/wall_reader.h"
#include "cli/option_checks.h"

#include <spdlog/spdlog.h>

namespace curvewall {

void addWallOption(CLI::App& subcommand, WallOption& wall) {
    subcommand.add_option("WALL", wall.path, "Wall file, or a calibration of another program")->required();
    subcommand.add_option("--size", wall.size,
                          "WIDTHxHEIGHT of a calibration that names no resolution, pixels");
}

Wall readWall(const WallOption& wall) {
    return readWall(wall.path, countsFrom("--size", "WIDTHxHEIGHT in pixels", wall.size, 1));
}

void logWarnings(const Wall& wall) {
    for (const Display& display : wall.displays)
        for (const std::string& warning : display.warnings) spdlog::warn("{}: {}", display.name, warning);
}

}  // namespace curvewall
