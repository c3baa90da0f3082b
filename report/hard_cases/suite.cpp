#include "report/hard_cases/suite.h"

#include "calibration/errors.h"
#include "calibration/stopwatch.h"
#include "renderer/gl/egl_context.h"
#include "renderer/image_file.h"
#include "report/content_key.h"
#include "report/hard_cases/wrong_pixels.h"
#include "report/kept_json.h"
#include "report/machine.h"
#include "report/step_clock.h"
#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>
#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

constexpr double kGuessedCaseMs = 5'000;  // until one has been run

std::vector<HardCaseMethod> methodsOf(const SuiteOptions& options) {
    std::vector<HardCaseMethod> methods = hardCaseMethods();
    if (!options.methods.empty())
        std::erase_if(methods, [&](const HardCaseMethod& method) {
            return std::ranges::find(options.methods, method.name) == options.methods.end();
        });
    return methods;
}

RenderRequest requestFor(const HardCase& tried) {
    RenderRequest request;
    request.wall = tried.wall;
    request.scene = tried.scene;
    request.camera = tried.camera;
    request.style = Style::unlit;
    return request;
}

struct JudgedTruth {
    Truth truth;
    MethodErrors errors;  // of its own
};

JudgedTruth truthOf(Renderer& renderer, const HardCase& tried) {
    RenderRequest request = requestFor(tried);
    request.method = Method::reference;
    DrawnOutputs drawn = drawOutputs(renderer, request);
    const Truth same{drawn.color, drawn.position, drawn.coverage, {}};
    const MethodErrors errors = errorsOf(drawn, same, tried.wall->displays.front());
    return {{std::move(drawn.color), std::move(drawn.position), std::move(drawn.coverage), {}}, errors};
}

// What a method has to hold for one case. Positions are told in single precision: where the display itself
// makes pixels of less than their roundings, as along a fold, the truth is as far off.
StatedBounds boundsOf(const HardCaseMethod& method, const MethodErrors& truth) {
    return {method.bounds.maxPx + 1.2 * truth.geometric.maxPx,
            method.bounds.p99Px + 1.2 * truth.geometric.p99Px};
}

std::string faultOf(const CaseResult& result, const StatedBounds& bounds, glm::ivec2 sizePx) {
    const MethodErrors& errors = result.errors;
    const auto mostWrong = static_cast<uint64_t>(mostWrongPixels(sizePx));
    if (errors.nanTexels > 0)
        return fmt::format("{} pixels have colours or positions that are no numbers", errors.nanTexels);
    if (errors.misplacedPixels > mostWrong)
        return fmt::format("{} pixels show what the display has no place for", errors.misplacedPixels);
    if (result.openPixels() > 0) return fmt::format("{} pixels have gaps", result.openPixels());
    if (result.addedPixels() > mostWrong)
        return fmt::format("{} pixels show what is not there", result.addedPixels());
    if (errors.geometric.maxPx > bounds.maxPx)
        return "off by " + measureText(errors.geometric.maxPx) + " px, more than " +
               measureText(bounds.maxPx);
    if (errors.geometric.p99Px > bounds.p99Px)
        return "1 pixel in 100 is off by " + measureText(errors.geometric.p99Px) + " px, more than " +
               measureText(bounds.p99Px);
    if (result.wrongPixels > mostWrong)
        return fmt::format("{} pixels have a colour that is not there", result.wrongPixels);
    return {};
}

class FamilyRun {
public:
    FamilyRun(Renderer& renderer, const HardCaseFamily& family, const SuiteOptions& options)
        : renderer_(renderer), family_(family), options_(options), methods_(methodsOf(options)) {
        result_.family = family.name;
        result_.sizePx = options.sizePx;
        if (!options.folder.empty()) std::filesystem::create_directories(options.folder);
    }

    // Whether the wall is one that anything is drawn on.
    bool runCase(double value) {
        try {
            const HardCase tried = family_.make(value, options_.sizePx);
            const JudgedTruth judged = truthOf(renderer_, tried);
            const Frame& position = judged.truth.position;
            result_.truths.push_back({value, "", checkTruth(position, tried), judged.errors.geometric.maxPx});
            if (isPictured(value)) addPicture("reference", value, judged.truth.color);
            for (const HardCaseMethod& method : methods_) draw(value, method, tried, judged);
            return true;
        } catch (const UsageError& refusal) {
            addRefusal(value, refusal.what());
        } catch (const InputError& refusal) {
            addRefusal(value, refusal.what());
        }
        return false;
    }

    FamilyResult take() { return std::move(result_); }

private:
    bool isPictured(double value) const {
        return !options_.folder.empty() && value == family_.values[family_.pictured];
    }

    void addRefusal(double value, const std::string& why) {
        result_.truths.push_back({value, why});
        for (const HardCaseMethod& method : methods_)
            result_.results.push_back({value, method.name, Outcome::refused, why});
    }

    void addPicture(const std::string& method, double value, const Frame& color) {
        const std::string file = "hard-case-" + stemOf(family_.name + "-" + method) + ".png";
        writeFrame((std::filesystem::path(options_.folder) / file).string(), color);
        result_.pictures.push_back(
            {file, fmt::format("{} at {:g} ({}): {}", family_.name, value, family_.parameter, method)});
    }

    void draw(double value, const HardCaseMethod& method, const HardCase& tried, const JudgedTruth& judged) {
        const Truth& truth = judged.truth;
        CaseResult result{value, method.name};
        const Display& display = tried.wall->displays.front();
        try {
            RenderRequest request = requestFor(tried);
            method.choose(request);
            const DrawnOutputs drawn = drawOutputs(renderer_, request);
            result.errors = errorsOf(drawn, truth, display);
            const bool isClosed = closesOnItself(display);
            result.wrongPixels = wrongPixels(drawn.color, truth.color, isClosed);
            result.gapPixels = gapPixels(drawn.coverage, truth.coverage, isClosed);
            result.displayPixels =
                static_cast<uint64_t>(display.sizePx.x) * static_cast<uint64_t>(display.sizePx.y);
            result.fault = faultOf(result, boundsOf(method, judged.errors), display.sizePx);
            if (isPictured(value) && (request.method == Method::piecewise || !result.fault.empty()))
                addPicture(method.name, value, drawn.color);
        } catch (const GlUnavailable&) {
            throw;
        } catch (const UsageError& refusal) {
            result.outcome = Outcome::refused;
            result.reason = refusal.what();
        } catch (const std::exception& failure) {
            result.outcome = Outcome::failed;
            result.reason = failure.what();
        }
        result_.results.push_back(std::move(result));
    }

    Renderer& renderer_;
    const HardCaseFamily& family_;
    const SuiteOptions& options_;
    std::vector<HardCaseMethod> methods_;
    FamilyResult result_;
};

// What earlier runs left of families in the folder, if there is one.
class KeptFamilies {
public:
    KeptFamilies(const SuiteOptions& options, GlDriver driver)
        : options_(options), driver_(std::move(driver)) {}

    // Nothing where the file is another's, of another run or damaged: the family is run again then.
    std::optional<FamilyResult> find(const HardCaseFamily& family) const {
        if (options_.folder.empty()) return std::nullopt;
        const std::optional<json> kept = keptJson(inFolder(fileOf(family)));
        try {
            if (!kept || kept->at("key") != keyOf(family)) return std::nullopt;
            FamilyResult result = familyResultFromJson(kept->at("result"));
            for (const CasePicture& picture : result.pictures)
                if (!std::filesystem::exists(inFolder(picture.file))) return std::nullopt;
            return result;
        } catch (const json::exception&) {
            return std::nullopt;
        }
    }

    void forget(const HardCaseFamily& family) const {
        if (!options_.folder.empty()) std::filesystem::remove(inFolder(fileOf(family)));
    }

    void keep(const HardCaseFamily& family, const FamilyResult& result) const {
        if (!options_.folder.empty())
            keepJson(inFolder(fileOf(family)), {{"key", keyOf(family)}, {"result", toJson(result)}});
    }

private:
    static std::string fileOf(const HardCaseFamily& family) {
        return "hard-case-" + stemOf(family.name) + ".json";
    }
    std::string inFolder(const std::string& file) const {
        return (std::filesystem::path(options_.folder) / file).string();
    }

    // All that a family's results depend on, as far as it can be told.
    json keyOf(const HardCaseFamily& family) const {
        json key{{"program", keyOfThisProgram()},   {"processor", processorName()},
                 {"gl_renderer", driver_.renderer}, {"gl_version", driver_.version},
                 {"family", family.name},           {"values", family.values},
                 {"size_px", options_.sizePx},      {"methods", json::array()}};
        for (const HardCaseMethod& method : methodsOf(options_))
            key["methods"].push_back(
                {method.name, fmt::format("{:g} {:g}", method.bounds.maxPx, method.bounds.p99Px)});
        return key;
    }

    const SuiteOptions& options_;
    GlDriver driver_;
};

}  // namespace

FamilyResult runFamily(Renderer& renderer, const HardCaseFamily& family, const SuiteOptions& options) {
    FamilyRun run(renderer, family, options);
    for (const double value : family.values) run.runCase(value);
    return run.take();
}

std::vector<FamilyResult> runFamilies(const std::vector<HardCaseFamily>& families,
                                      const SuiteOptions& options, const OnProgress& onProgress) {
    const KeptFamilies kept(options, glDriver());
    std::vector<std::optional<FamilyResult>> results;
    Progress progress;
    StepClock clock(kGuessedCaseMs);
    for (const HardCaseFamily& family : families) {
        results.push_back(kept.find(family));
        progress.all += family.values.size();
        if (!results.back()) clock.expect(family.values.size());
    }
    const auto run = [&](const HardCaseFamily& family) {
        kept.forget(family);  // whose pictures are overwritten
        // It keeps what belongs to scenes and displays, and each case has others.
        Renderer renderer(1);
        FamilyRun cases(renderer, family, options);
        for (const double value : family.values) {
            progress.leftMs = clock.leftMs();
            progress.doing = family.name;
            onProgress(progress);
            const Stopwatch watch;
            if (cases.runCase(value))
                clock.took(watch.ms());
            else
                clock.skipped();
            ++progress.done;
        }
        FamilyResult result = cases.take();
        kept.keep(family, result);
        return result;
    };
    std::vector<FamilyResult> all;
    for (size_t i = 0; i < families.size(); ++i) {
        if (results[i]) progress.done += families[i].values.size();
        all.push_back(results[i] ? std::move(*results[i]) : run(families[i]));
    }
    return all;
}

}  // namespace curvewall
