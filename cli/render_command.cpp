// curvewall render

#include "calibration/errors.h"
#include "cli/camera_option.h"
#include "cli/commands.h"
#include "cli/display_paths.h"
#include "cli/option_checks.h"
#include "cli/wall_option.h"
#include "renderer/image_file.h"
#include "renderer/names.h"
#include "renderer/render.h"
#include "renderer/scene/load_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <fstream>
#include <memory>
#include <optional>
#include <string>

namespace curvewall {
namespace {

struct RenderCommand {
    WallOption wall;
    std::string display, scene, camera, eye,
        method = "piecewise", engine = "compute", source = "cube", filter = "linear", faces = "separate",
        lookup = "pixel", bounds = "triangle", style = "textured", outputKind = "color", out, stats;
    double tolerancePx = kDefaultTolerancePx;
    double tessellationPx = 0;
    int samples = 1, faceSizePx = 0, meshStepPx = kDefaultMeshStepPx, frames = 1;
    std::optional<int> anisotropy;
};

RenderRequest requestOf(const RenderCommand& command) {
    RenderRequest request;
    request.method = methodFromName(command.method).value();
    request.engine = engineFromName(command.engine).value();
    request.style = styleFromName(command.style).value();
    request.output = outputKindFromName(command.outputKind).value();
    request.tolerancePx = command.tolerancePx;
    request.tessellationPx = command.tessellationPx;
    request.samples = command.samples;
    request.anisotropy = command.anisotropy;
    request.source = sourceFromName(command.source).value();
    request.filter = filterFromName(command.filter).value();
    request.faceSizePx = command.faceSizePx;
    request.facePass = facePassFromName(command.faces).value();
    request.lookup = lookupFromName(command.lookup).value();
    request.meshStepPx = command.meshStepPx;
    request.bounds = boundsFromName(command.bounds).value();
    request.frames = command.frames;
    request.timesStages = request.measuresError = !command.stats.empty();
    if (!command.camera.empty()) request.camera = cameraFromText(command.camera);
    if (!command.eye.empty()) request.eyeM = eyeFromText(command.eye);
    if (command.out.empty()) return request;
    const ImageFormat format = imageFormatFromPath(command.out);
    request.linearOutput = format == ImageFormat::exr;
    if (request.output != OutputKind::color && format != ImageFormat::exr)
        throw UsageError("--output-kind " + command.outputKind + " needs an .exr file, not " + command.out);
    return request;
}

void writeStats(const std::string& path, const RenderStats& stats) {
    std::ofstream file(path);
    file << toJson(stats).dump(2) << "\n";
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

std::string summaryOf(const RenderStats& stats) {
    if (stats.pieces > 0)
        return fmt::format("{} pieces, error {:.4f} px at most, {:.2f} pairs a triangle", stats.pieces,
                           stats.geometricError.maxPx, stats.replicationRatio());
    if (stats.faces > 0)
        return fmt::format("{} {} of {} px, error {:.4f} px at most", stats.faces,
                           stats.faces == 1 ? "picture" : "pictures", stats.faceSizePx,
                           stats.geometricError.maxPx);
    if (!stats.bounds.empty()) return fmt::format("bounded by a {}", stats.bounds);
    if (stats.method == "vertex-warp")
        return fmt::format("{} parts, error {:.4f} px at most", stats.pairs, stats.geometricError.maxPx);
    return fmt::format("{} rays a pixel", stats.samples);
}

void report(const Display& display, const RenderStats& stats, const std::string& out) {
    fmt::print("{}: {}, {}, {:.1f} ms a frame{}\n", display.name, stats.method, summaryOf(stats),
               stats.frameMsMedian, out.empty() ? "" : " -> " + out);
    if (stats.choice) fmt::print("  {}\n", stats.choice->why);
}

void run(const RenderCommand& command) {
    RenderRequest request = requestOf(command);
    request.wall = std::make_shared<const Wall>(readWall(command.wall));
    logWarnings(*request.wall);
    const std::vector<const Display*> displays = chosenDisplays(*request.wall, command.display);
    for (const Display* display : displays)
        for (const std::string& path : {command.out, command.stats})
            requireFolderOf(pathForDisplay(path, display->name, displays.size() > 1));
    request.scene = std::make_shared<const Scene>(loadScene(command.scene));
    for (const std::string& note : request.scene->notes) spdlog::warn("{}: {}", command.scene, note);
    if (command.camera.empty()) request.camera = request.scene->defaultCamera;

    Renderer renderer;
    for (const Display* display : displays) {
        request.display = display->name;
        const RenderResult result = renderer.render(request);
        const std::string out = pathForDisplay(command.out, display->name, displays.size() > 1);
        const std::string stats = pathForDisplay(command.stats, display->name, displays.size() > 1);
        if (!out.empty()) writeFrame(out, result.frame, request.output);
        if (!stats.empty()) writeStats(stats, result.stats);
        report(*display, result.stats, out);
    }
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    auto command = std::make_shared<RenderCommand>();
    CLI::App* render = app.add_subcommand("render", "Render a scene for a wall, into image files");
    const auto oneOf = [](auto parse, const std::string& names) {
        return CLI::Validator([=](std::string& text) { return parse(text) ? "" : "expected " + names; }, "");
    };
    addWallOption(*render, command->wall);
    render->add_option("--display", command->display, "Display of the wall; all of them without it");
    render
        ->add_option("--scene", command->scene, "A .gltf, .glb or .obj file, city[:triangles[:seed]] or room")
        ->required();
    render->add_option("--camera", command->camera,
                       "Pose of the wall in the scene, x,y,z[,yaw,pitch,roll] in metres and degrees");
    render->add_option("--eye", command->eye,
                       "Where the eye is, x,y,z in wall coordinates, metres; the wall's own without it");
    render->add_option("--method", command->method, methodNames())
        ->check(oneOf(methodFromName, methodNames()))
        ->capture_default_str();
    render->add_option("--engine", command->engine, "How piecewise replicates triangles: " + engineNames())
        ->check(oneOf(engineFromName, engineNames()))
        ->capture_default_str();
    render->add_option("--tolerance", command->tolerancePx, "Largest geometric error of piecewise, pixels")
        ->check(CLI::Validator(checkTolerance, ""))
        ->capture_default_str();
    render
        ->add_option("--tessellation", command->tessellationPx,
                     "How long edges of vertex-warp's triangles may be on the screen, pixels; 0: as they are")
        ->check(CLI::Validator(checkTessellation, ""))
        ->capture_default_str();
    render->add_option("--samples", command->samples, "Samples a pixel, or a texel of image-based")
        ->check(CLI::Range(1, kMostSamples))
        ->capture_default_str();
    render
        ->add_option(
            "--anisotropy", command->anisotropy,
            "Of texture filtering by the raster methods; without it what the GPU can, and 1 in software")
        ->check(CLI::Range(1, kMostAnisotropy));
    render->add_option("--source", command->source, "What image-based resamples: " + sourceNames())
        ->check(oneOf(sourceFromName, sourceNames()))
        ->capture_default_str();
    render->add_option("--filter", command->filter, "How image-based resamples: " + filterNames())
        ->check(oneOf(filterFromName, filterNames()))
        ->capture_default_str();
    render->add_option("--faces", command->faces, "How image-based draws the faces: " + facePassNames())
        ->check(oneOf(facePassFromName, facePassNames()))
        ->capture_default_str();
    render->add_option("--lookup", command->lookup, "Where image-based looks the source up: " + lookupNames())
        ->check(oneOf(lookupFromName, lookupNames()))
        ->capture_default_str();
    render->add_option("--mesh-step", command->meshStepPx, "Of --lookup mesh: pixels along a cell")
        ->check(CLI::Range(kLeastMeshStepPx, kMostMeshStepPx))
        ->capture_default_str();
    render
        ->add_option("--face-size", command->faceSizePx,
                     "Side of a cube face or longer side of the planar source, pixels; 0: from the display's "
                     "densest place")
        ->check(CLI::Validator(checkFaceSize, ""))
        ->capture_default_str();
    render
        ->add_option("--bounds", command->bounds,
                     "What bounded-raycast draws around triangles: " + boundsNames())
        ->check(oneOf(boundsFromName, boundsNames()))
        ->capture_default_str();
    render->add_option("--style", command->style, styleNames())
        ->check(oneOf(styleFromName, styleNames()))
        ->capture_default_str();
    render
        ->add_option("--output-kind", command->outputKind,
                     outputKindNames() + "; all but color need an .exr file")
        ->check(oneOf(outputKindFromName, outputKindNames()))
        ->capture_default_str();
    render
        ->add_option("--frames", command->frames,
                     "Frames to measure; frame k turns the camera by 360 k / N degrees")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    render->add_option("--out", command->out,
                       "Picture of frame 0: .png, .jpg or .exr; {display} is replaced");
    render->add_option("--stats", command->stats, "Statistics as JSON; {display} is replaced");
    render->callback([command] { run(*command); });
}

}  // namespace curvewall
