#include "tests/report/made_up_report.h"

#include <cmath>

namespace curvewall::test {
namespace {

constexpr double kFloorShare = 0.004;

void addPiecewise(ViewReport& view, double piecesAtOnePx) {
    for (const double tolerancePx : {2.0, 1.0, 0.5, 0.25, 0.1, 0.05}) {
        const double pieces = std::round(piecesAtOnePx / tolerancePx);
        view.settings.push_back(madeUpSetting("piecewise", "", "tolerance_px", tolerancePx,
                                              0.99 * tolerancePx, 52 + 0.006 * pieces));
        view.settings.back().stats["pieces"] = pieces;
        view.settings.back().stats["pairs"] = 30000 + 2 * pieces;
        view.settings.back().stats["stage_ms"] = {
            {"holes", 1.2}, {"meshlets", 4.1}, {"triangles", 9 + 0.002 * pieces}, {"surfaces", 38.5}};
    }
}

void addImageBased(ViewReport& view, const std::string& filter, double baseMs) {
    for (const double facePx : {512, 1024, 2048, 4096}) {
        view.settings.push_back(madeUpSetting("image-based", "cube, " + filter, "face_size_px", facePx,
                                              1180 / facePx, baseMs + 3.4e-5 * facePx * facePx));
        view.settings.back().errors.image.shareOff = kFloorShare + 6 / facePx;
        view.settings.back().stats["faces"] = 5;
        view.settings.back().stats["face_size_px"] = facePx;
    }
}

void addVertexWarp(ViewReport& view) {
    for (const double edgePx : {64, 32, 16, 8, 4})
        view.settings.push_back(madeUpSetting("vertex-warp", "", "tessellation_px", edgePx,
                                              0.009 * edgePx * edgePx, 48 + 900 / edgePx));
}

ViewReport madeUpView(const std::string& wall, const std::string& display, glm::ivec2 sizePx) {
    ViewReport view;
    view.wall = wall;
    view.display = display;
    view.scene = "city";
    view.sizePx = sizePx;
    view.truth = {64, 52.5, "", ""};
    view.floors = {{1, kFloorShare, 0, 49.5, 31.2}, {4, 0.5 * kFloorShare, 0, 52, 36.1}};
    return view;
}

}  // namespace

SettingResult madeUpSetting(const std::string& method, const std::string& variant, const std::string& knob,
                            double value, double errorPx, double frameMs) {
    SettingResult result;
    result.setting = {method, variant, knob, value, 1};
    result.errors.geometric = {errorPx, 0.8 * errorPx, 0.3 * errorPx, {100, 200}, 1, 0, 1000};
    result.errors.image = {kFloorShare + 0.001 * errorPx, 48 - 6 * std::log2(1 + errorPx),
                           1 - 0.004 * errorPx, 120};
    result.errors.supersampledPsnrDb = 31.2 - 0.4 * errorPx;
    result.frameMs = {frameMs, 0.97 * frameMs, 1.06 * frameMs};
    result.stats = {{"method", method}, {"triangles", 35000},
                    {"pairs", 31000},   {"peak_memory_mib", 412.5},
                    {"overdraw", 0.0},  {"gpu_memory_mib", {{"scene", 22.1}, {"pairs", 3.4}}}};
    return result;
}

SpeedReport madeUpReport() {
    ViewReport dome = madeUpView("dome-master", "dome", {2048, 2048});
    dome.projection = "radial";
    addPiecewise(dome, 418);
    addImageBased(dome, "linear", 60);
    addImageBased(dome, "bicubic", 155);
    addVertexWarp(dome);
    dome.settings.push_back(madeUpSetting("bounded-raycast", "triangle", "", 0, 0.0008, 412));
    dome.settings.back().stats["overdraw"] = 0.31;

    ViewReport cylinder = madeUpView("full-cylinder", "front", {1600, 1200});
    cylinder.projection = "cylinder";
    addPiecewise(cylinder, 39);
    addImageBased(cylinder, "linear", 90);
    SettingResult refused;
    refused.setting = {"bounded-raycast", "triangle", "", 0, 1};
    refused.refusal =
        "bounded-raycast draws round lenses seen from the lens, and this display is a cylinder; piecewise "
        "draws it";
    cylinder.settings.push_back(refused);
    return {"llvmpipe (LLVM 15.0.6, 256 bits)", "Intel Xeon, 2 cores", 0.25, {dome, cylinder}};
}

}  // namespace curvewall::test
