// curvewall report

#include "calibration/errors.h"
#include "cli/camera_option.h"
#include "cli/commands.h"
#include "cli/display_paths.h"
#include "cli/option_checks.h"
#include "cli/progress_bar.h"
#include "cli/wall_option.h"
#include "renderer/names.h"
#include "renderer/scene/load_scene.h"
#include "report/document.h"
#include "report/hard_cases/hard_cases_document.h"
#include "report/hard_cases/suite.h"
#include "report/measurement.h"
#include "report/speed_document.h"
#include "report/speed_report_json.h"
#include "report/text_file.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {
namespace {

constexpr int kQuickSuitePx = 128;

struct ReportCommand {
    std::vector<std::string> walls;
    std::string size, camera, eye, style = "textured", suite, out, references;
    std::vector<std::string> scenes, displays;
    double tolerancePx = kDefaultTolerancePx;
    int rounds = 3, frames = 3;
    bool isQuick = false;
};

// report.html, report.md and report.json, with the plots beside them.
void writeReport(const std::string& folder, const Document& document, const nlohmann::json& json) {
    writePlots(document, folder);
    writeTextFile(folder + "/report.html", htmlOf(document, folder));
    writeTextFile(folder + "/report.md", markdownOf(document));
    writeTextFile(folder + "/report.json",
                  json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    fmt::print("{0}/report.html, {0}/report.md, {0}/report.json\n", folder);
}

// Those of the wall that have one of the names; all of them without names.
std::vector<const Display*> namedDisplays(const Wall& wall, const std::vector<std::string>& names) {
    std::vector<const Display*> displays = chosenDisplays(wall, "");
    if (names.empty()) return displays;
    std::erase_if(displays, [&](const Display* display) {
        return std::ranges::find(names, display->name) == names.end();
    });
    if (displays.empty()) chosenDisplays(wall, names.front());  // says which there are
    return displays;
}

std::vector<View> viewsOf(const ReportCommand& command) {
    std::vector<View> views;
    std::vector<ScenePtr> scenes;
    for (const std::string& scene : command.scenes) {
        scenes.push_back(std::make_shared<const Scene>(loadScene(scene)));
        for (const std::string& note : scenes.back()->notes) spdlog::warn("{}: {}", scene, note);
    }
    for (const std::string& path : command.walls) {
        auto wall = std::make_shared<const Wall>(readWall({path, command.size}));
        logWarnings(*wall);
        if (!command.eye.empty())
            wall = std::make_shared<const Wall>(seenFrom(*wall, eyeFromText(command.eye)));
        for (const Display* display : namedDisplays(*wall, command.displays))
            for (size_t i = 0; i < scenes.size(); ++i) {
                RenderRequest request;
                request.wall = wall;
                request.display = display->name;
                request.scene = scenes[i];
                request.camera =
                    command.camera.empty() ? scenes[i]->defaultCamera : cameraFromText(command.camera);
                request.style = styleFromName(command.style).value();
                request.tolerancePx = command.tolerancePx;
                views.push_back({request, std::filesystem::path(path).stem().string(),
                                 std::filesystem::path(command.scenes[i]).stem().string()});
            }
    }
    return views;
}

// A name that no wall has is a mistake, though those of others are there.
void requireKnown(const std::vector<std::string>& displays, const std::vector<View>& views) {
    for (const std::string& name : displays)
        if (std::ranges::none_of(views, [&](const View& view) { return view.request.display == name; }))
            throw UsageError("--display: no wall has a display \"" + name + "\"");
}

// Runs `measure` under a progress bar.
template <class Measure>
auto withProgressBar(const Measure& measure) {
    ProgressBar bar;
    return measure([&bar](const Progress& progress) {
        bar.show(progress.done, progress.all, progress.leftMs, progress.doing);
    });
}

void reportSpeed(const ReportCommand& command) {
    if (command.walls.empty()) throw UsageError("report needs a WALL, or --suite hard-cases");
    if (command.scenes.empty()) throw UsageError("report needs a --scene");
    MeasurementPlan plan;
    plan.views = viewsOf(command);
    requireKnown(command.displays, plan.views);
    makeFolder(command.out);
    plan.tolerancePx = command.tolerancePx;
    plan.extent = command.isQuick ? Extent::quick : Extent::full;
    plan.rounds = command.rounds;
    plan.frames = command.frames;
    plan.folder = command.out;
    plan.references = command.references.empty() ? command.out + "/references" : command.references;
    const SpeedReport report =
        withProgressBar([&](const OnProgress& onProgress) { return measureSpeed(plan, onProgress); });
    writeReport(command.out, speedDocument(report), report);
}

void reportHardCases(const ReportCommand& command) {
    makeFolder(command.out);
    SuiteOptions options;
    options.folder = command.out;
    if (command.isQuick) options.sizePx = kQuickSuitePx;
    const std::vector<FamilyResult> results = withProgressBar(
        [&](const OnProgress& onProgress) { return runFamilies(hardCaseFamilies(), options, onProgress); });
    auto json = nlohmann::json::array();
    for (const FamilyResult& family : results) json.push_back(toJson(family));
    writeReport(command.out, hardCasesDocument(results), {{"families", json}});
}

// The other options are of walls, scenes and measurements, which a suite brings itself.
void requireOptionsOfSuite(const CLI::App& report) {
    constexpr std::array<std::string_view, 3> kOfSuite{"--suite", "--out", "--quick"};
    for (const CLI::Option* option : report.get_options())
        if (option->count() > 0 && std::ranges::find(kOfSuite, option->get_name()) == kOfSuite.end())
            throw UsageError("--suite hard-cases brings its own walls and scenes, and takes no " +
                             option->get_name());
}

void run(const CLI::App& report, const ReportCommand& command) {
    if (command.suite.empty()) return reportSpeed(command);
    requireOptionsOfSuite(report);
    reportHardCases(command);
}

}  // namespace

void addReportCommand(CLI::App& app) {
    auto command = std::make_shared<ReportCommand>();
    CLI::App* report = app.add_subcommand(
        "report", "Measure every method's speed against its error on a wall, or the hard cases");
    const auto oneOf = [](auto parse, const std::string& names) {
        return CLI::Validator([=](std::string& text) { return parse(text) ? "" : "expected " + names; }, "");
    };
    report->add_option("WALL", command->walls, "Wall files, or calibrations of other programs");
    report->add_option("--size", command->size,
                       "WIDTHxHEIGHT of a calibration that names no resolution, pixels");
    report->add_option(
        "--scene", command->scenes,
        "A .gltf, .glb or .obj file, city[:triangles[:seed]] or room; may be given several times");
    report->add_option("--out", command->out, "Folder of the report, made where it is missing")->required();
    report->add_option("--display", command->displays,
                       "Display of the walls; all of them without it; may be given several times");
    report->add_option("--camera", command->camera,
                       "Pose of the wall in the scene, x,y,z[,yaw,pitch,roll] in metres and degrees");
    report->add_option("--eye", command->eye,
                       "Where the eye is, x,y,z in wall coordinates, metres; the wall's own without it");
    report->add_option("--style", command->style, styleNames())
        ->check(oneOf(styleFromName, styleNames()))
        ->capture_default_str();
    report->add_option("--tolerance", command->tolerancePx, "The error that the wall is to keep, pixels")
        ->check(CLI::Validator(checkTolerance, ""))
        ->capture_default_str();
    report->add_flag("--quick", command->isQuick,
                     "Few settings and a truth of fewer rays; of a suite, small displays");
    report->add_option("--rounds", command->rounds, "How often each setting is timed, in turns")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    report->add_option("--frames", command->frames, "Frames of a round")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    report->add_option("--references", command->references,
                       "Folder that keeps the truth for other reports; OUT/references without it");
    report->add_option("--suite", command->suite, "hard-cases: the numerical stability suite")
        ->check(CLI::IsMember({"hard-cases"}));
    report->callback([report, command] { run(*report, *command); });
}

}  // namespace curvewall
