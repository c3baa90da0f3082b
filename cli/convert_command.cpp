// curvewall convert

#include "calibration/errors.h"
#include "calibration/files/file_bytes.h"
#include "calibration/writers/conversion.h"
#include "cli/camera_option.h"
#include "cli/commands.h"
#include "cli/display_paths.h"
#include "cli/option_checks.h"
#include "cli/wall_option.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ConvertCommand {
    WallOption wall;
    std::string out, as, display, grid, eye;
    bool asJson = false;
};

struct KindName {
    const char* word;
    ConvertedKind kind;
    std::initializer_list<const char*> extensions;
};

const std::initializer_list<KindName> kKinds{
    {"surface-map", ConvertedKind::surfaceMap, {".exr"}},
    {"camera-texture", ConvertedKind::cameraTexture, {}},
    {"pfm", ConvertedKind::pfm, {".pfm"}},
    {"bourke", ConvertedKind::bourke, {".data", ".map"}},
    {"mpcdi", ConvertedKind::mpcdi, {".mpcdi"}},
};

// Maps are EXR files, so that nobody finds another format under the name.
void requireExtension(const ConvertCommand& command, const std::string& extension, const char* expected) {
    if (extension != expected)
        throw UsageError("--as " + command.as + " writes " + expected + " files, and OUT is \"" +
                         command.out + "\"");
}

ConvertedKind kindOf(const ConvertCommand& command) {
    const std::string extension = lowerCase(fs::path(command.out).extension().string());
    std::string words;
    for (const KindName& name : kKinds) {
        words += (words.empty() ? "" : ", ") + std::string(name.word);
        if (command.as.empty()) {
            for (const char* known : name.extensions)
                if (extension == known) return name.kind;
        } else if (command.as == name.word) {
            if (extension == ".json")
                throw UsageError("OUT: the wall file beside the converted one gets the extension .json");
            if (name.kind == ConvertedKind::surfaceMap || name.kind == ConvertedKind::cameraTexture)
                requireExtension(command, extension, ".exr");
            return name.kind;
        }
    }
    if (command.as.empty())
        throw UsageError("OUT: expected an .exr, .pfm, .data, .map or .mpcdi file or --as, found \"" +
                         command.out + "\"");
    throw UsageError("--as: expected one of " + words + ", found \"" + command.as + "\"");
}

ConversionRequest requestOf(const ConvertCommand& command, const Wall& wall) {
    ConversionRequest request;
    request.kind = kindOf(command);
    request.displays = chosenDisplays(wall, command.display);
    request.grid = countsFrom("--grid", "COLUMNSxROWS of nodes", command.grid, 2);
    if (request.kind == ConvertedKind::mpcdi) {
        request.paths = {command.out};
        return request;
    }
    for (const Display* display : request.displays)
        request.paths.push_back(pathForDisplay(command.out, display->name, request.displays.size() > 1));
    request.wallPath =
        fs::path(pathForDisplay(command.out, "wall", false)).replace_extension(".json").string();
    return request;
}

// JSON has no infinity.
json numberOrNull(double number) { return std::isfinite(number) ? json(number) : json(); }

json reportOf(const ConvertedDisplay& converted) {
    const ConversionError& error = converted.error;
    return {{"name", converted.name},
            {"file", converted.path},
            {"nodes", {converted.nodes.x, converted.nodes.y}},
            {"conversion_error_px",
             {{"max", numberOrNull(error.maxPx)},
              {"p99", numberOrNull(error.p99Px)},
              {"mean", numberOrNull(error.meanPx)},
              {"max_at", {error.maxAt.x, error.maxAt.y}}}},
            {"holes_gained", error.holesGained},
            {"holes_lost", error.holesLost},
            {"blend_difference", error.blendDifference}};
}

void printReport(const ConvertedDisplay& converted) {
    const ConversionError& e = converted.error;
    fmt::print("{}: {} x {} nodes -> {}\n", converted.name, converted.nodes.x, converted.nodes.y,
               converted.path);
    fmt::print(
        "  error of the conversion over every pixel: {:.4g} px at most (at {}, {}), 99 % below {:.4g}, mean "
        "{:.4g}\n",
        e.maxPx, e.maxAt.x, e.maxAt.y, e.p99Px, e.meanPx);
    if (e.holesGained + e.holesLost > 0)
        fmt::print("  {} pixels see nothing any more, {} see something that saw nothing before\n",
                   e.holesGained, e.holesLost);
    if (e.blendDifference > 0)
        fmt::print("  blending is off by {:.4g} of full light at most\n", e.blendDifference);
}

void run(const ConvertCommand& command) {
    requireFolderOf(command.out);
    const Wall read = readWall(command.wall);
    const Wall wall = command.eye.empty() ? read : seenFrom(read, eyeFromText(command.eye));
    logWarnings(wall);
    const ConversionRequest request = requestOf(command, wall);
    const std::vector<ConvertedDisplay> converted = convertWall(wall, request);
    if (command.asJson) {
        json report = {{"displays", json::array()}};
        for (const ConvertedDisplay& display : converted) report["displays"].push_back(reportOf(display));
        if (!request.wallPath.empty()) report["wall_file"] = request.wallPath;
        fmt::print("{}\n", report.dump(2));
        return;
    }
    for (const ConvertedDisplay& display : converted) printReport(display);
    if (!request.wallPath.empty()) fmt::print("wall file: {}\n", request.wallPath);
}

}  // namespace

void addConvertCommand(CLI::App& app) {
    auto command = std::make_shared<ConvertCommand>();
    CLI::App* convert =
        app.add_subcommand("convert", "Write a wall in the files of other programs, and say what that costs");
    addWallOption(*convert, command->wall);
    convert
        ->add_option("OUT", command->out,
                     "File to write; several displays write OUT-NAME.ext, or replace {display} in it")
        ->required();
    convert->add_option("--as", command->as,
                        "surface-map or camera-texture (.exr), pfm, bourke (.data, .map) or mpcdi; by the "
                        "extension of OUT without it");
    convert->add_option("--display", command->display, "Display of the wall; all of them without it");
    convert->add_option("--grid", command->grid,
                        "COLUMNSxROWS of nodes from border to border; without it one a pixel, and for bourke "
                        "as many as 0.25 px need, up to 512 columns");
    convert->add_option("--eye", command->eye,
                        "Where the eye is, x,y,z in wall coordinates, metres; the wall's own without it");
    convert->add_flag("--json", command->asJson, "Report as JSON");
    convert->callback([command] { run(*command); });
}

}  // namespace curvewall
