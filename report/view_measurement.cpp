#include "report/view_measurement.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/scene/room.h"
#include "report/content_key.h"
#include "report/flat_scene.h"
#include "report/kept_json.h"
#include "report/sampling_floor.h"
#include "report/speed_report_json.h"
#include "report/view_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace curvewall {
namespace {

constexpr Supersampling kFullTruth{64, 4, 60};
constexpr Supersampling kQuickTruth{16, 2, 60};

const char* nameOf(Extent extent) { return extent == Extent::full ? "full" : "quick"; }

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

std::string keyOfMeasured(const std::string& viewKey, const GlDriver& driver) {
    ContentKey key;
    key.add(viewKey);
    key.add(driver.renderer);
    key.add(driver.version);
    return key.text().substr(0, kShortKey);
}

// Of the request's method and display.
RoomCoverage coverageOfRoom(Renderer& renderer, RenderRequest request, const Display& display) {
    // Beside its middle: nothing is symmetric.
    constexpr glm::dvec3 kEyeM{0.13, 0.21, -0.17};
    static const ScenePtr room = std::make_shared<const Scene>(makeRoom());
    request.scene = room;
    request.camera = {kEyeM - request.wall->eyeM, {}};
    request.output = OutputKind::coverage;
    request.samples = request.frames = 1;
    request.timesStages = false;
    const Frame counts = [&] {
        try {
            return renderer.render(request).frame;
        } catch (const UsageError& refused) {
            throw UsageError(std::string("the closed room that coverage is counted in: ") + refused.what());
        }
    }();
    RoomCoverage coverage;
    for (int y = 0; y < counts.sizePx.y; ++y)
        for (int x = 0; x < counts.sizePx.x; ++x) {
            const float count = *counts.at(x, y);
            coverage.twiceCoveredPixels += count > 1;
            coverage.uncoveredPixels += count == 0 && display.projection->unproject(centreOf({x, y}));
        }
    return coverage;
}

}  // namespace

ViewMeasurement::ViewMeasurement(const View& view, const MeasurementPlan& plan, const GlDriver& driver)
    : view_(view),
      plan_(plan),
      display_(findDisplay(*view.request.wall, view.request.display)),
      supersampling_(plan.extent == Extent::full ? kFullTruth : kQuickTruth),
      settings_(settingsFor(view.request, plan.extent)),
      viewKey_(keyOfView(view.request)),
      key_(keyOfMeasured(viewKey_, driver)),
      rounds_(settings_.size()) {
    report_.wall = view.wallName;
    report_.display = display_.name;
    report_.scene = view.sceneName;
    report_.sizePx = display_.sizePx;
    report_.projection = display_.projectionType;
    report_.settings.resize(settings_.size());
}

std::vector<Step> ViewMeasurement::steps() {
    const std::string where = fmt::format("{}, {}: ", display_.name, view_.sceneName);
    const auto isThere = [](const std::string& path) { return std::filesystem::exists(path); };
    std::vector<Step> steps;
    steps.push_back(
        {StepKind::truth, where + "truth", isTruthKept(viewKey_, supersampling_, plan_.references), [this] {
             findTruth();
             return true;
         }});
    steps.push_back({StepKind::floor, where + "sampling floor", isThere(pathOfFloors()),
                     [this] { return findFloors(); }});
    std::vector<bool> isRefused;
    for (size_t i = 0; i < settings_.size(); ++i) {
        const std::optional<SettingResult> kept = keptErrors(i);
        isRefused.push_back(kept && !kept->refusal.empty());
        steps.push_back({StepKind::errors, where + "errors of " + settings_[i].name.text(), kept.has_value(),
                         [this, i] { return findErrors(i); }});
    }
    for (int round = 0; round < plan_.rounds; ++round)
        for (size_t i = 0; i < settings_.size(); ++i)
            steps.push_back({StepKind::round,
                             fmt::format("{}round {} of {}", where, round + 1, settings_[i].name.text()),
                             isRefused[i] || isThere(pathOfRound(i, round)),
                             [this, i, round] { return takeRound(i, round); }});
    return steps;
}

ViewReport ViewMeasurement::finish() {
    for (size_t i = 0; i < settings_.size(); ++i)
        if (!rounds_[i].empty()) report_.settings[i].frameMs = spreadOf(rounds_[i]);
    cropPictures(report_, truth_->pictures, plan_.folder, key_);
    return std::move(report_);
}

std::string ViewMeasurement::pathOf(const std::string& what) const {
    return fmt::format("{}/measured/{}-{}.json", plan_.folder, key_, what);
}
std::string ViewMeasurement::pathOfFloors() const {
    return pathOf(fmt::format("{}-floors", nameOf(plan_.extent)));
}
std::string ViewMeasurement::pathOfErrors(size_t i) const { return pathOf(keyOfErrors(i)); }
std::string ViewMeasurement::pathOfRound(size_t i, int round) const {
    return pathOf(fmt::format("{}-{}-frames-round-{}", keyOf(settings_[i].name), plan_.frames, round));
}
std::string ViewMeasurement::keyOfErrors(size_t i) const {
    return fmt::format("{}-{:g}-px-{}-frames-{}", nameOf(plan_.extent), view_.request.tolerancePx,
                       plan_.frames, keyOf(settings_[i].name));
}

// Made where something has to be compared with it.
const ViewMeasurement::FlatView& ViewMeasurement::flat() {
    if (!flat_) {
        const ScenePtr scene = flatScene(*view_.request.scene);
        RenderRequest request = inFlatColors(view_.request, scene);
        request.method = Method::reference;
        flat_ = FlatView{scene, renderer_.render(request).frame};
    }
    return *flat_;
}

// With the pieces of its tolerance, fitted once for all that need them.
RenderRequest ViewMeasurement::requestOf(const Setting& setting) {
    RenderRequest request = setting.request;
    if (request.method != Method::piecewise) return request;
    auto& pieces = pieces_[request.tolerancePx];
    if (!pieces) pieces = std::make_shared<const FittedPieces>(fitPieces(display_, request.tolerancePx));
    request.pieces = pieces;
    return request;
}

// Nothing where a picture of theirs is lost.
std::optional<SettingResult> ViewMeasurement::keptErrors(size_t i) const {
    auto kept = keptValue<SettingResult>(pathOfErrors(i));
    if (!kept) return std::nullopt;
    for (const std::string& file : {kept->picture, kept->errorMap})
        if (!file.empty() && !std::filesystem::exists(plan_.folder + "/" + file)) return std::nullopt;
    return kept;
}

void ViewMeasurement::findTruth() {
    truth_ = keptTruth(view_.request, viewKey_, supersampling_, plan_.references);
    report_.truth = truth_->facts;
}

bool ViewMeasurement::findFloors() {
    if (const auto kept = keptValue<std::vector<SamplingFloor>>(pathOfFloors())) {
        report_.floors = *kept;
        return false;
    }
    const std::vector<RenderRequest> windows = flatWindows(view_.request);
    std::vector<KnownTruth> truths;
    truths.reserve(windows.size());
    for (const RenderRequest& window : windows)
        truths.push_back(keptTruth(window, keyOfView(window), supersampling_, plan_.references));
    for (const int samples : plan_.extent == Extent::full ? std::vector{1, 4, 16} : std::vector{1})
        if (const auto floor = samplingFloor(renderer_, windows, truths, flat().scene, samples))
            report_.floors.push_back(*floor);
    keepJson(pathOfFloors(), report_.floors);
    return true;
}

bool ViewMeasurement::findErrors(size_t i) {
    SettingResult& result = report_.settings[i];
    if (const auto kept = keptErrors(i)) {
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
        result.room = coverageOfRoom(renderer_, request, display_);
        if (request.samples == 1)
            result.edges =
                compareColor(renderer_.render(inFlatColors(request, flat().scene)).frame, flat().truth);
        result.stats = toJson(drawn.stats);
        result.stats.erase("frame_ms");  // that of the rounds counts
        if (settings_[i].isShown)
            writePictures(result, drawn, display_, view_.request.tolerancePx, plan_.folder,
                          fmt::format("{}-{}", key_, keyOfErrors(i)));
    } catch (const UsageError& refused) {
        result.refusal = refused.what();
    }
    keepJson(pathOfErrors(i), result);
    return result.refusal.empty();
}

bool ViewMeasurement::takeRound(size_t i, int round) {
    if (!report_.settings[i].refusal.empty()) return false;
    const std::string path = pathOfRound(i, round);
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

}  // namespace curvewall
