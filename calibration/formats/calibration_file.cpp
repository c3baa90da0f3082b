#include "calibration/formats/calibration_file.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/formats/camera_yaml.h"
#include "calibration/formats/display_names.h"
#include "calibration/formats/frustum_file.h"
#include "calibration/formats/map_file_calibration.h"
#include "calibration/formats/mesh_calibration.h"
#include "calibration/formats/mesh_file.h"
#include "calibration/formats/mpcdi_file.h"
#include "calibration/formats/sgct_file.h"
#include "calibration/formats/vioso_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

struct Format {
    const char* name;
    bool (*isOne)(const FileBytes& file);
    Wall (*read)(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                 Decisions& decisions);
};

Wall readMeshWall(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                  Decisions& decisions) {
    Wall wall{.name = file.stem(), .eyeM = request.eyeM.value_or(glm::dvec3(0))};
    wall.displays.push_back(meshDisplay(readMesh(file, find, decisions), file, request, decisions));
    return wall;
}

// A mesh has its frustum in a file beside it; by itself that is a flat display.
Wall readFrustumWall(const FileBytes& file, const FindFile&, const CalibrationRequest& request,
                     Decisions& decisions) {
    const Frustum frustum = readFrustumFile(file, decisions);
    const double aspect = (std::tan(frustum.rightRad) - std::tan(frustum.leftRad)) /
                          (std::tan(frustum.upRad) - std::tan(frustum.downRad));
    Display display{.name = safeDisplayName(file.stem()), .projectionType = "frustum"};
    display.sizePx = decideSize(request, {}, aspect, decisions);
    display.projection = std::make_shared<FrustumProjection>(frustum, display.sizePx);
    listDecisions(decisions, display);
    Wall wall{.name = file.stem(), .eyeM = request.eyeM.value_or(glm::dvec3(0))};
    wall.displays.push_back(std::move(display));
    return wall;
}

constexpr std::initializer_list<Format> kFormats{
    {"a configuration of SGCT", isSgctFile, readSgctFile},
    {"an MPCDI archive or manifest", isMpcdi, readMpcdi},
    {"a VIOSO warp file", isViosoFile, readViosoFile},
    {"a PFM or EXR map", isMapFile, readMapFile},
    {"a frustum of domeprojection", isFrustumFile, readFrustumWall},
    {"a warp mesh", isMeshFile, readMeshWall},
    {"a camera in YAML", isCameraYaml, readCameraYaml},
};

// The first one that claims the file.
const Format* findFormat(const FileBytes& file) {
    const auto format = std::ranges::find_if(kFormats, [&](const Format& f) { return f.isOne(file); });
    return format == kFormats.end() ? nullptr : &*format;
}

const Format& formatOf(const FileBytes& file) {
    if (const Format* format = findFormat(file)) return *format;
    std::string names = "a wall file in JSON";
    for (const Format& format : kFormats) names += ", " + std::string(format.name);
    throw InputError(file.path, "", "one of " + names, "a file that begins like none of them");
}

std::string sizeText(glm::ivec2 sizePx) { return fmt::format("{} x {}", sizePx.x, sizePx.y); }

}  // namespace

bool isCalibration(const FileBytes& file) { return findFormat(file) != nullptr; }

Wall readCalibration(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                     Decisions& decisions) {
    Wall wall = formatOf(file).read(file, find, request, decisions);
    wall.name = safeDisplayName(wall.name);  // that of the file
    if (!request.display.empty())
        std::erase_if(wall.displays, [&](const Display& d) { return d.name != request.display; });
    if (wall.displays.empty())
        throw InputError(file.path, "", "a display named \"" + request.display + "\"", "none of that name");
    return wall;
}

glm::ivec2 decideSize(const CalibrationRequest& request, std::optional<glm::ivec2> fileSizePx,
                      std::optional<double> aspect, Decisions& decisions) {
    constexpr int kUsualWidthPx = 1920;
    constexpr double kUsualAspect = 16.0 / 9.0, kSameAspect = 0.01;
    if (aspect && !(*aspect > 0 && std::isfinite(*aspect))) aspect.reset();
    if (!aspect && fileSizePx) aspect = static_cast<double>(fileSizePx->x) / fileSizePx->y;
    if (request.sizePx) {
        const double shape = static_cast<double>(request.sizePx->x) / request.sizePx->y;
        if (aspect && std::abs(shape / *aspect - 1) > kSameAspect)
            decisions.warn(
                fmt::format("size: {} was asked for, {:.4f} times as wide as high, but the file is made "
                            "for a display {:.4f} times as wide as high",
                            sizeText(*request.sizePx), shape, *aspect));
        return *request.sizePx;
    }
    if (fileSizePx) return *fileSizePx;
    const double shape = aspect.value_or(kUsualAspect);
    const std::string why =
        fmt::format("the file names no resolution; {}", aspect ? "its shape does" : "16:9 is usual");
    const int width =
        static_cast<int>(decisions.number("width_px", {1, double{kMostPx}}, kUsualWidthPx, why));
    const double height = std::clamp(std::round(width / shape), 1.0, double{kMostPx});
    return {width, static_cast<int>(decisions.number("height_px", {1, double{kMostPx}}, height, why))};
}

void listDecisions(const Decisions& decisions, Display& display) {
    display.assumptions = decisions.taken();
    display.warnings = decisions.warnings();
}

}  // namespace curvewall
