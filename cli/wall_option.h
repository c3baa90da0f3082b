#pragma once
// WALL and --size: the wall that a subcommand works on, a wall file or a calibration of another program.

#include "calibration/wall.h"

#include <CLI/CLI.hpp>

#include <string>

namespace curvewall {

struct WallOption {
    std::string path;
    std::string size;  // "1920x1080", empty without one
};

// `wall` must outlive the parsing.
void addWallOption(CLI::App& subcommand, WallOption& wall);

// Throws like readWall.
Wall readWall(const WallOption& wall);

// Says where the files of the displays contradict themselves.
void logWarnings(const Wall& wall);

}  // namespace curvewall
