// curvewall inspect

#include "calibration/errors.h"
#include "calibration/pieces/lower_bound.h"
#include "calibration/pieces/piece_drawing.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/pixel_rays.h"
#include "calibration/stopwatch.h"
#include "cli/blend_mask_files.h"
#include "cli/camera_option.h"
#include "cli/commands.h"
#include "cli/display_paths.h"
#include "cli/option_checks.h"
#include "cli/refit_report.h"
#include "cli/wall_option.h"
#include "renderer/image_file.h"
#include "renderer/render.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

struct InspectCommand {
    WallOption wall;
    std::string display, eye, errorMap, pieces, rays, blend;
    double tolerancePx = kDefaultTolerancePx;
    bool asJson = false, refit = false, lowerBound = false, readOnly = false;
};

json reportOf(const Display& display) {
    json assumptions = json::array();
    for (const Assumption& a : display.assumptions)
        assumptions.push_back(
            {{"key", a.key}, {"value", a.value}, {"evidence", a.evidence}, {"given", a.isGiven}});
    return {{"name", display.name},
            {"size", {display.sizePx.x, display.sizePx.y}},
            {"projection", display.projectionType},
            {"assumptions", std::move(assumptions)},
            {"warnings", display.warnings}};
}

void addFit(json& report, double tolerancePx, const FittedPieces& fitted) {
    const Certificate& certificate = fitted.certificate;
    report.update({{"tolerance_px", tolerancePx},
                   {"pieces", fitted.mesh.pieces.size()},
                   {"geometric_error_px",
                    {{"max", certificate.maxPx},
                     {"p99", certificate.p99Px},
                     {"mean", certificate.meanPx},
                     {"max_at", {certificate.maxAt.x, certificate.maxAt.y}}}},
                   {"uncovered_pixels", certificate.uncoveredPixels},
                   {"holes", certificate.holes},
                   {"fit_ms", fitted.fitMs},
                   {"certify_ms", fitted.certifyMs}});
}

void printReport(const Display& display) {
    fmt::print("{}: {} x {} px, {}\n", display.name, display.sizePx.x, display.sizePx.y,
               display.projectionType);
    for (const Assumption& a : display.assumptions)
        fmt::print("  {} {} {} ({})\n", a.isGiven ? "given  " : "assumed", a.key, a.value, a.evidence);
    for (const std::string& warning : display.warnings) fmt::print("  warning: {}\n", warning);
}

void printFit(double tolerancePx, const FittedPieces& fitted) {
    const Certificate& c = fitted.certificate;
    fmt::print("  {} pieces for a tolerance of {} px, fitted in {:.0f} ms, certified in {:.0f} ms\n",
               fitted.mesh.pieces.size(), tolerancePx, fitted.fitMs, fitted.certifyMs);
    fmt::print(
        "  geometric error over every pixel: {:.4f} px at most (at {}, {}), 99 % below {:.4f}, mean {:.4f}\n",
        c.maxPx, c.maxAt.x, c.maxAt.y, c.p99Px, c.meanPx);
    fmt::print("  {} pixels without a piece, {} holes\n", c.uncoveredPixels, c.holes);
}

// Any mesh has at least so many pieces.
void addLowerBound(json& report, size_t pieces, double bound) {
    report["lower_bound_pieces"] = bound;
    report["pieces_over_lower_bound"] = static_cast<double>(pieces) / bound;
}

void printLowerBound(size_t pieces, double bound) {
    fmt::print("  lower bound of the number of pieces: {:.1f}, so {:.2f} times as many as the bound\n", bound,
               static_cast<double>(pieces) / bound);
}

Frame errorFrame(const Display& display, const FittedPieces& fitted) {
    return {display.sizePx, 1, fitted.errorsPx};
}

// The unit ray of every pixel centre, NaN in holes.
Frame rayFrame(const Display& display) {
    Frame frame{display.sizePx, 3, {}};
    const PixelRays rays(*display.projection, display.sizePx);
    for (int y = 0; y < display.sizePx.y; ++y) {
        for (int x = 0; x < display.sizePx.x; ++x) {
            const glm::vec3 unit(glm::normalize(rays.at({x, y})));
            frame.texels.insert(frame.texels.end(), {unit.x, unit.y, unit.z});
        }
    }
    return frame;
}

void writePieces(const std::string& path, const PieceMesh& mesh) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".json" && extension != ".svg")
        throw UsageError("--pieces: expected a .json or .svg file, found \"" + path + "\"");
    std::ofstream file(path);
    file << (extension == ".json" ? piecesAsJson(mesh).dump(1) : piecesAsSvg(mesh)) << "\n";
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

Wall fromEye(const Wall& wall, const InspectCommand& command) {
    return command.eye.empty() ? wall : seenFrom(wall, eyeFromText(command.eye));
}

void run(const InspectCommand& command) {
    if (!command.blend.empty() && !command.display.empty())
        throw UsageError(
            "--blend needs the whole wall: a mask depends on the displays around; leave out --display");
    if (command.refit && command.eye.empty())
        throw UsageError("--refit needs --eye: where the eye goes from the wall's own");
    if (command.readOnly &&
        (command.refit || command.lowerBound || !command.errorMap.empty() || !command.pieces.empty()))
        throw UsageError(
            "--read-only fits no pieces; leave out --refit, --lower-bound, --error-map and --pieces");
    const Stopwatch loading;
    const Wall ownWall = readWall(command.wall);
    const Wall wall = fromEye(ownWall, command);
    const double loadMs = loading.ms();
    const std::vector<const Display*> displays = chosenDisplays(wall, command.display);
    if (!command.blend.empty()) makeFolder(command.blend);
    json report = {{"wall", wall.name}, {"load_ms", loadMs}, {"displays", json::array()}};
    if (!command.asJson) fmt::print("{}: loaded in {:.0f} ms\n", wall.name, loadMs);
    for (const Display* display : displays) {
        const auto path = [&](const std::string& option) {
            return pathForDisplay(option, display->name, displays.size() > 1);
        };
        for (const std::string& option : {command.errorMap, command.rays, command.pieces})
            requireFolderOf(path(option));
        if (command.asJson)
            report["displays"].push_back(reportOf(*display));
        else
            printReport(*display);
        if (!command.rays.empty()) writeFrame(path(command.rays), rayFrame(*display), OutputKind::position);
        if (command.readOnly) continue;
        std::optional<FollowedPieces> followed;
        if (command.refit)
            followed = followPieces(findDisplay(ownWall, display->name), *display, command.tolerancePx);
        const FittedPieces fitted =
            followed ? std::move(followed->pieces) : fitPieces(*display, command.tolerancePx);
        if (!command.errorMap.empty()) writeFrame(path(command.errorMap), errorFrame(*display, fitted));
        if (!command.pieces.empty()) writePieces(path(command.pieces), fitted.mesh);
        if (command.asJson) {
            json& entry = report["displays"].back();
            addFit(entry, command.tolerancePx, fitted);
            if (followed) entry["refit"] = toJson(*followed);
        } else {
            printFit(command.tolerancePx, fitted);
            if (followed) printReport(*followed);
        }
        if (!command.lowerBound) continue;
        const size_t pieces = fitted.mesh.pieces.size();
        const double bound = lowerBoundOfPieces(*display->projection, display->sizePx, command.tolerancePx);
        if (command.asJson)
            addLowerBound(report["displays"].back(), pieces, bound);
        else
            printLowerBound(pieces, bound);
    }
    if (!command.blend.empty()) {
        const BlendMaskFiles files = writeBlendMasks(wall, command.wall.path, command.blend);
        if (command.asJson)
            report["blend"] = toJson(files);
        else
            printReport(files);
    }
    if (command.asJson) fmt::print("{}\n", report.dump(2));
}

}  // namespace

void addInspectCommand(CLI::App& app) {
    auto command = std::make_shared<InspectCommand>();
    CLI::App* inspect = app.add_subcommand("inspect", "Fit the pieces of a wall and certify their error");
    const CLI::Validator exrFile(
        [](std::string& path) { return path.ends_with(".exr") ? "" : "expected an .exr file"; }, "");
    addWallOption(*inspect, command->wall);
    inspect->add_option("--display", command->display, "Display of the wall; all of them without it");
    inspect->add_option("--eye", command->eye,
                        "Where the eye is, x,y,z in wall coordinates, metres; the wall's own without it");
    inspect->add_flag("--refit", command->refit,
                      "Fit at the wall's own eye and let the pieces follow to --eye");
    inspect->add_option("--tolerance", command->tolerancePx, "Largest geometric error, pixels")
        ->check(CLI::Validator(checkTolerance, ""))
        ->capture_default_str();
    inspect->add_flag(
        "--read-only", command->readOnly,
        "Only read the wall: what was assumed of its files and where they contradict themselves");
    inspect->add_flag("--json", command->asJson, "Report as JSON");
    inspect->add_flag("--lower-bound", command->lowerBound,
                      "Also estimate how many pieces any mesh needs at least, which takes seconds");
    inspect
        ->add_option("--error-map", command->errorMap, "Error of every pixel in pixels, .exr, NaN in holes")
        ->check(exrFile);
    inspect->add_option("--pieces", command->pieces,
                        "The pieces: .json (vertices and pieces) or .svg (a drawing)");
    inspect->add_option("--rays", command->rays, "Unit ray of every pixel centre, .exr, NaN in holes")
        ->check(exrFile);
    inspect->add_option("--blend", command->blend,
                        "Folder, made where it is missing, for masks that blend the displays: "
                        "DISPLAY-alpha.png, 16-bit, linear");
    inspect->callback([command] { run(*command); });
}

}  // namespace curvewall
