#include "calibration/formats/vioso_file.h"

#include "calibration/errors.h"
#include "calibration/formats/blend_files.h"
#include "calibration/formats/display_names.h"
#include "calibration/formats/map_decisions.h"
#include "calibration/formats/vioso_blocks.h"
#include "calibration/formats/vioso_config.h"
#include "calibration/projections/bilinear_cell.h"
#include "calibration/projections/frustum.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

namespace curvewall {
namespace {

constexpr double kMillimetreM = 0.001;

struct WarpContext {
    const FileBytes& file;
    const ViosoWarp& warp;
    const std::optional<ViosoView>& view;
    const CalibrationRequest& request;
};

// Axes of the program that uses the file: right-handed like the wall's, or with z ahead where its matrix
// mirrors.
struct HostFrame {
    glm::dmat3 wallFromHost{1};
    double unitM = 1;
};

std::optional<HostFrame> hostFrame(const std::optional<ViosoView>& view) {
    if (!view || !view->viosoFromHost) return std::nullopt;
    const double determinant = glm::determinant(glm::dmat3(*view->viosoFromHost));
    HostFrame host;
    host.unitM = std::cbrt(std::abs(determinant)) * kMillimetreM;  // VIOSO's points are in millimetres
    if (determinant < 0) host.wallFromHost[2][2] = -1;
    return host;
}

void requireUsable(const std::optional<ViosoView>& view, const std::string& path) {
    constexpr double kMost = 1e7;
    if (view && view->eye && largestCoordinate(*view->eye) > kMost)
        throw InputError(path, "eye", "numbers within ten million",
                         fmt::format("{:g}", largestCoordinate(*view->eye)));
    if (!view || !view->viosoFromHost) return;
    const double determinant = glm::determinant(glm::dmat3(*view->viosoFromHost));
    if (!(std::abs(determinant) > 1e-12 && std::abs(determinant) < 1e18))
        throw InputError(path, "trans", "a matrix that can be inverted",
                         fmt::format("a determinant of {:g}", determinant));
}

PointFrame pointFrame(const WarpContext& c, const MapSurvey& survey, Decisions& decisions) {
    const auto host = hostFrame(c.view);
    if (!host) return decideFrame({kMillimetreM, std::nullopt}, survey, decisions);
    const glm::dmat4 hostFromVioso = glm::inverse(*c.view->viosoFromHost);
    return {host->wallFromHost * glm::dmat3(hostFromVioso), host->unitM,
            host->unitM * (host->wallFromHost * glm::dvec3(hostFromVioso[3]))};
}

SourcePicture pictureOf(const WarpContext& c, glm::ivec2 sizePx, Decisions& decisions) {
    const auto& view = c.view;
    if (c.request.source) return *c.request.source;
    if (!view || !view->fovDeg || view->isAutomatic)
        return decideSource(false, "the file does not say what its content shows", sizePx, decisions);
    const glm::dvec3 direction = glm::radians(view->directionDeg.value_or(glm::dvec3(0)));
    const glm::dvec4 fov = glm::radians(*view->fovDeg);
    try {
        return {sizePx, std::make_shared<FrustumProjection>(
                            Frustum{.leftRad = -fov[0],
                                    .rightRad = fov[2],
                                    .downRad = -fov[3],
                                    .upRad = fov[1],
                                    .orientation = {direction.y, direction.x, direction.z}},
                            sizePx)};
    } catch (const UsageError& error) {
        throw InputError(c.file.path, "VIOSOWarpBlend.ini: fov", "a frustum", error.what());
    }
}

ProjectionPtr readProjection(const WarpContext& c, Display& display, glm::dvec3 eyeM, Decisions& decisions) {
    const ViosoWarp& warp = c.warp;
    const std::string path = c.file.path + ": " + warp.place;
    const MapSurvey survey = surveyMap(warp.numbers, false);
    if (!survey.hasNodes) throw InputError(path, "", "a map", "no valid sample anywhere");
    if ((warp.flags & vioso::kPoints) != 0) {
        display.projectionType = "surface_map";
        return projectionOfSurface(warp.numbers, pointFrame(c, survey, decisions), false, Alignment::centers,
                                   display.sizePx, eyeM, path);
    }
    display.projectionType = "camera_texture";
    MapMeaning meaning;
    // A border of one per cent lies around the content.
    if ((warp.flags & vioso::kBorder) != 0) meaning.sourceRect = {glm::dvec2(-0.01), glm::dvec2(1.02)};
    return projectionOfMap(warp.numbers, meaning, display.sizePx, pictureOf(c, display.sizePx, decisions),
                           path);
}

BlendMapsPtr readBlend(const ViosoWarp& warp, const std::string& path, glm::ivec2 sizePx,
                       Decisions& decisions) {
    if (warp.hasWhite) decisions.warn(warp.place + ": its third bitmap, a colour correction, is not used");
    if (!warp.blend && !warp.black) return nullptr;
    const double gamma =
        decisions.number("intensity_gamma", {0, 10, true}, 2.2, "VIOSO multiplies encoded colours");
    BlendMaps blend;
    if (warp.blend) blend.alpha = linearPicture(*warp.blend, path, sizePx, gamma, warp.place, decisions);
    const bool hasLevels = (warp.flags & vioso::kBlackLevel) != 0;
    if (warp.black && hasLevels && warp.blackScale > 0) {
        NumberMap black = *warp.black;
        for (float& value : black.values) value = std::min(value * warp.blackScale, 1.0f);
        blend.beta = linearPicture(black, path, sizePx, gamma, warp.place, decisions);
        if (warp.blackDark != 0 || warp.blackBright != 0)
            decisions.warn(
                fmt::format("{}: the black level's dark ({:g}) and bright ({:g}) factors are not used",
                            warp.place, warp.blackDark, warp.blackBright));
    } else if (warp.black) {
        decisions.warn(warp.place + ": its second bitmap, a black level, has no scale and is not used");
    }
    if (blend.empty()) return nullptr;
    return std::make_shared<const BlendMaps>(std::move(blend));
}

std::string nameOf(const FileBytes& file, const std::vector<ViosoWarp>& warps, size_t index) {
    if (!warps[index].name.empty()) return warps[index].name;
    return warps.size() == 1 ? file.stem() : fmt::format("{}-{}", file.stem(), index + 1);
}

std::vector<std::optional<ViosoView>> viewsOf(const FileBytes& file, const FindFile& find, size_t warps) {
    constexpr size_t kMostBytes = size_t{1} << 20;
    std::vector<std::optional<ViosoView>> views(warps);
    const auto ini = find("VIOSOWarpBlend.ini");
    if (!ini) return views;
    if (ini->bytes.size() > kMostBytes)
        throw InputError(ini->path, "", "at most a megabyte", std::to_string(ini->bytes.size()) + " bytes");
    for (size_t i = 0; i < warps; ++i) {
        views[i] = findViosoView(*ini, file.name(), static_cast<int>(i));
        requireUsable(views[i], ini->path);
    }
    return views;
}

// A wall has one eye: the user's, or else the one that the first channel with an eye has.
glm::dvec3 eyeOf(const std::vector<std::optional<ViosoView>>& views, const CalibrationRequest& request) {
    if (request.eyeM) return *request.eyeM;
    for (const auto& view : views)
        if (view && view->eye) {
            const HostFrame host = hostFrame(view).value_or(HostFrame{});
            return host.unitM * (host.wallFromHost * *view->eye);
        }
    return glm::dvec3(0);
}

}  // namespace

bool isViosoFile(const FileBytes& file) { return isVioso(file.bytes); }

Wall readViosoFile(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                   Decisions& decisions) {
    const std::vector<ViosoWarp> warps = parseVioso(file);
    const std::vector<std::optional<ViosoView>> views = viewsOf(file, find, warps.size());
    Wall wall{.name = file.stem(), .eyeM = eyeOf(views, request)};
    std::set<std::string> taken;
    for (size_t i = 0; i < warps.size(); ++i) {
        const ViosoWarp& warp = warps[i];
        Display display;
        display.name = uniqueName(safeDisplayName(nameOf(file, warps, i)), taken);
        if (!request.display.empty() && display.name != request.display) continue;
        if (warp.numbers.values.empty()) {
            decisions.warn(warp.place + ": a warp without data, which makes no display");
            continue;
        }
        Decisions own = decisions;
        if ((warp.flags & vioso::kSplit) != 0)
            own.warn(warp.place + ": a part of a split display, which is read as a display of its own");
        display.sizePx = decideSize(request, warp.numbers.sizePx, std::nullopt, own);
        display.projection = readProjection({file, warp, views[i], request}, display, wall.eyeM, own);
        display.blend = readBlend(warp, file.path, display.sizePx, own);
        listDecisions(own, display);
        wall.displays.push_back(std::move(display));
    }
    if (wall.displays.empty() && request.display.empty())
        throw InputError(file.path, "", "a warp with data", "none");
    return wall;
}

}  // namespace curvewall
