#include "report/measurement.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/stopwatch.h"
#include "renderer/scene/room.h"
#include "report/content_key.h"
#include "report/flat_scene.h"
#include "report/kept_json.h"
#include "report/machine.h"
#include "report/sampling_floor.h"
#include "report/speed_report_json.h"
#include "report/view_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

namespace curvewall {
namespace {

constexpr Supersampling kFullTruth{64, 4, 60};
constexpr Supersampling kQuickTruth{16, 2, 60};

enum class StepKind { truth, floor, errors, round, pictures };

struct Step {
    StepKind kind;
    std::string doing;
    std::function<bool()> take;  // whether there was anything left to do
};

// Tells how much longer it takes.
class StepClock {
public:
    void took(StepKind kind, double ms) {
        Kind& known = kinds_[static_cast<size_t>(kind)];
        known.sumMs += ms;
        ++known.count;
    }
    double expectedMs(StepKind kind) const {
        const Kind& known = kinds_[static_cast<size_t>(kind)];
        return known.count == 0 ? known.guessMs : known.sumMs / known.count;
    }

private:
    struct Kind {
        double guessMs;
        double sumMs = 0;
        int count = 0;
    };
    // In the order of StepKind.
    std::array<Kind, 5> kinds_{{{60'000}, {10'000}, {5'000}, {2'000}, {1'000}}};
};

// Of an even number the median is between the middle two.
Spread spreadOf(std::vector<double> values) {
    std::ranges::sort(values);
    const size_t middle = values.size() / 2;
    return {0.5 * (values[middle] + values[values.size() - 1 - middle]), values.front(), values.back()};
}

std::string keyOf(const SettingName& name) {
    ContentKey key;
    key.add(name.method);
    key.add(name.variant);
    key.add(name.knob);
    key.addNumber(name.value);
    key.addNumber(name.samples);
    return key.text().substr(0, kShortKey);
}

// What is measured of one view, and kept in files that are named by its content.
class ViewMeasurement {
public:
    ViewMeasurement(const View& view, const MeasurementPlan& plan)
        : view_(view),
          plan_(plan),
          display_(findDisplay(*view.request.wall, view.request.display)),
          flat_(flatScene(*view.request.scene)),
          room_(std::make_shared<const Scene>(makeRoom())),
          settings_(settingsFor(view.request, plan.extent)) {
        report_.wall = view.wallName;
        report_.display = display_.name;
        report_.scene = view.sceneName;
        report_.sizePx = display_.sizePx;
        report_.projection = display_.projectionType;
        report_.settings.resize(settings_.size());
        rounds_.resize(settings_.size());
    }

    std::vector<Step> steps() {
        const std::string where = fmt::format("{}, {}: ", display_.name, view_.sceneName);
        std::vector<Step> steps{{StepKind::truth, where + "truth", [this] { return traceTruth(); }},
                                {StepKind::floor, where + "sampling floor", [this] { return findFloors(); }}};
        const auto add = [&](StepKind kind, const std::string& what, auto take) {
            for (size_t i = 0; i < settings_.size(); ++i)
                steps.push_back({kind, where + what + settings_[i].name.text(), [=] { return take(i); }});
        };
        add(StepKind::errors, "errors of ", [this](size_t i) { return findErrors(i); });
        for (int round = 0; round < plan_.rounds; ++round)
            add(StepKind::round, fmt::format("round {} of ", round + 1),
                [this, round](size_t i) { return takeRound(i, round); });
        return steps;
    }

    ViewReport finish() {
        for (size_t i = 0; i < settings_.size(); ++i)
            if (!rounds_[i].empty()) report_.settings[i].frameMs = spreadOf(rounds_[i]);
        cropPictures(report_, truth_->pictures, plan_.folder, key_.substr(0, kShortKey));
        return std::move(report_);
    }

private:
    const Supersampling& supersampling() const {
        return plan_.extent == Extent::full ? kFullTruth : kQuickTruth;
    }

    std::string pathOf(const std::string& what) const {
        return fmt::format("{}/measured/{}-{}.json", plan_.folder, key_.substr(0, kShortKey), what);
    }
    std::string keyOfErrors(size_t i) const {
        return fmt::format("{}-{:g}-px-{}-frames-{}", plan_.extent == Extent::full ? "full" : "quick",
                           view_.request.tolerancePx, plan_.frames, keyOf(settings_[i].name));
    }

    bool traceTruth() {
        key_ = keyOfView(view_.request);
        truth_ = keptTruth(view_.request, key_, supersampling(), plan_.references);
        report_.truth = truth_->facts;
        RenderRequest edges = inFlatColors(view_.request, flat_);
        edges.method = Method::reference;
        flatTruth_ = renderer_.render(edges).frame;
        return true;
    }

    bool findFloors() {
        const std::string path = pathOf(plan_.extent == Extent::full ? "full-floors" : "quick-floors");
        if (const auto kept = keptValue<std::vector<SamplingFloor>>(path)) {
            report_.floors = *kept;
            return false;
        }
        const std::vector<RenderRequest> windows = flatWindows(view_.request);
        std::vector<KnownTruth> truths;
        truths.reserve(windows.size());
        for (const RenderRequest& window : windows)
            truths.push_back(keptTruth(window, keyOfView(window), supersampling(), plan_.references));
        for (const int samples : plan_.extent == Extent::full ? std::vector{1, 4, 16} : std::vector{1})
            if (const auto floor = samplingFloor(renderer_, windows, truths, flat_, samples))
                report_.floors.push_back(*floor);
        keepJson(path, report_.floors);
        return true;
    }

    // With the pieces of its tolerance, fitted once for all that need them.
    RenderRequest requestOf(const Setting& setting) {
        RenderRequest request = setting.request;
        if (request.method != Method::piecewise) return request;
        auto& pieces = pieces_[request.tolerancePx];
        if (!pieces) pieces = std::make_shared<const FittedPieces>(fitPieces(display_, request.tolerancePx));
        request.pieces = pieces;
        return request;
    }

    bool hasItsPictures(const SettingResult& result) const {
        return std::ranges::all_of(std::array{result.picture, result.errorMap}, [&](const std::string& file) {
            return file.empty() || std::filesystem::exists(plan_.folder + "/" + file);
        });
    }

    bool findErrors(size_t i) {
        SettingResult& result = report_.settings[i];
        const std::string path = pathOf(keyOfErrors(i));
        if (const auto kept = keptValue<SettingResult>(path); kept && hasItsPictures(*kept)) {
            result = *kept;
            return false;
        }
        result.setting = settings_[i].name;
        try {
            RenderRequest request = requestOf(settings_[i]);
            request.frames = plan_.frames;
            request.timesStages = true;
            const DrawnOutputs drawn = drawOutputs(renderer_, request);
            result.errors = errorsOf(drawn, truth_->pictures, display_);
            result.room = coverageOfRoom(request);
            if (request.samples == 1)
                result.edges = compareColor(renderer_.render(inFlatColors(request, flat_)).frame, flatTruth_);
            result.stats = toJson(drawn.stats);
            result.stats.erase("frame_ms");  // that of the rounds counts
            if (settings_[i].isShown)
                writePictures(result, drawn, display_, view_.request.tolerancePx, plan_.folder,
                              fmt::format("{}-{}", key_.substr(0, kShortKey), keyOfErrors(i)));
        } catch (const UsageError& refused) {
            result.refusal = refused.what();
        }
        keepJson(path, result);
        return true;
    }

    RoomCoverage coverageOfRoom(RenderRequest request) {
        // Beside its middle: nothing is symmetric.
        constexpr glm::dvec3 kEyeM{0.13, 0.21, -0.17};
        request.scene = room_;
        request.camera = {kEyeM - request.wall->eyeM, {}};
        request.output = OutputKind::coverage;
        request.samples = request.frames = 1;
        request.timesStages = false;
        const Frame counts = renderer_.render(request).frame;
        RoomCoverage coverage;
        for (int y = 0; y < counts.sizePx.y; ++y)
            for (int x = 0; x < counts.sizePx.x; ++x) {
                const float count = *counts.at(x, y);
                coverage.twiceCoveredPixels += count > 1;
                coverage.uncoveredPixels += count == 0 && display_.projection->unproject(centreOf({x, y}));
            }
        return coverage;
    }

    bool takeRound(size_t i, int round) {
        if (!report_.settings[i].refusal.empty()) return false;
        const std::string path =
            pathOf(fmt::format("{}-{}-frames-round-{}", keyOf(settings_[i].name), plan_.frames, round));
        if (const auto kept = keptValue<double>(path)) {
            rounds_[i].push_back(*kept);
            return false;
        }
        RenderRequest request = requestOf(settings_[i]);
        request.frames = plan_.frames;
        rounds_[i].push_back(renderer_.render(request).stats.frameMsMedian);
        keepJson(path, rounds_[i].back());
        return true;
    }

    const View& view_;
    const MeasurementPlan& plan_;
    const Display& display_;
    const ScenePtr flat_, room_;
    std::vector<Setting> settings_;
    std::string key_;
    Frame flatTruth_;
    Renderer renderer_;
    std::map<double, std::shared_ptr<const FittedPieces>> pieces_;
    std::optional<KnownTruth> truth_;
    std::vector<std::vector<double>> rounds_;  // of each setting
    ViewReport report_;
};

// The same for all.
std::string rendererNameOf(const SpeedReport& report) {
    for (const ViewReport& view : report.views)
        for (const SettingResult& result : view.settings)
            if (result.refusal.empty() && result.setting.method != "reference")
                return result.stats.value("gl_renderer", "");
    return "";
}

}  // namespace

SpeedReport measureSpeed(const MeasurementPlan& plan,
                         const std::function<void(const MeasurementProgress&)>& advance) {
    SpeedReport report;
    report.processor = processorName();
    report.tolerancePx = plan.tolerancePx;
    std::vector<std::unique_ptr<ViewMeasurement>> measurements;
    std::vector<Step> steps;  // of all views, one after the other
    for (const View& view : plan.views) {
        const auto& measurement = measurements.emplace_back(std::make_unique<ViewMeasurement>(view, plan));
        for (Step& step : measurement->steps()) steps.push_back(std::move(step));
        steps.push_back(
            {StepKind::pictures, "pictures", [&report, &measurements, at = measurements.size() - 1] {
                 report.views.push_back(measurements[at]->finish());
                 measurements[at].reset();  // and its pictures and pieces
                 return true;
             }});
    }
    StepClock clock;
    for (size_t i = 0; i < steps.size(); ++i) {
        double leftMs = 0;
        for (size_t left = i; left < steps.size(); ++left) leftMs += clock.expectedMs(steps[left].kind);
        advance({i, steps.size(), leftMs, steps[i].doing});
        const Stopwatch watch;
        if (steps[i].take()) clock.took(steps[i].kind, watch.ms());
    }
    report.glRenderer = rendererNameOf(report);
    return report;
}

}  // namespace curvewall
