#include "report/recommendation.h"

#include <algorithm>
#include <map>

namespace curvewall {
namespace {

// Rasterizers put corners on a grid of 1/256 px, half a step off along both axes at most, so that what is
// certified to keep a tolerance may show as much more.
constexpr double kGridPx = 0.003;
constexpr double kHardlyAPixel = 1e-5;  // of all

double errorPx(const SettingResult* result) { return result->errors.geometric.maxPx; }
double frameMs(const SettingResult* result) { return result->frameMs.median; }

const SettingResult* fastest(const std::vector<const SettingResult*>& results, double tolerancePx,
                             glm::ivec2 sizePx) {
    const SettingResult* best = nullptr;
    for (const SettingResult* result : results)
        if (keeps(*result, tolerancePx, sizePx) && (!best || frameMs(result) < frameMs(best))) best = result;
    return best;
}

// What even exact rays show aside: where lines are drawn as wide as pixels, their points lie in the middle.
double errorOfTruthPx(const ViewReport& view) {
    for (const SettingResult& result : view.settings)
        if (result.setting.method == "reference" && result.refusal.empty()) return errorPx(&result);
    return 0;
}

}  // namespace

uint64_t faultyPixels(const SettingResult& result) {
    return coverageFaults(result) + result.errors.misplacedPixels + result.errors.nanTexels;
}

bool keeps(const SettingResult& result, double tolerancePx, glm::ivec2 sizePx) {
    const double pixels = static_cast<double>(sizePx.x) * sizePx.y;
    return result.refusal.empty() && errorPx(&result) <= tolerancePx + kGridPx &&
           static_cast<double>(faultyPixels(result)) <= kHardlyAPixel * pixels;
}

Recommendation recommend(const ViewReport& view, double askedPx) {
    const double ownPx = errorOfTruthPx(view), tolerancePx = askedPx + ownPx;
    std::vector<std::string> methods;
    std::map<std::string, std::vector<const SettingResult*>> drawn;
    std::vector<const SettingResult*> all;
    for (const SettingResult& result : view.settings) {
        const std::string& method = result.setting.method;
        if (method == "reference" || result.setting.samples > 1) continue;
        if (std::ranges::find(methods, method) == methods.end()) methods.push_back(method);
        if (!result.refusal.empty()) continue;
        drawn[method].push_back(&result);
        all.push_back(&result);
    }
    Recommendation answer;
    answer.best = fastest(all, tolerancePx, view.sizePx);
    answer.halfError = fastest(all, askedPx / 2 + ownPx, view.sizePx);
    for (const std::string& method : methods) {
        const std::vector<const SettingResult*>& results = drawn[method];
        if (results.empty()) {
            answer.refusing.push_back(method);
        } else if (const SettingResult* kept = fastest(results, tolerancePx, view.sizePx); !kept) {
            answer.missing.push_back(*std::ranges::min_element(results, {}, errorPx));
        } else if (kept->setting.method != answer.best->setting.method) {
            answer.others.push_back(kept);
        }
    }
    std::ranges::stable_sort(answer.others, {}, frameMs);
    std::ranges::stable_sort(answer.missing, {}, errorPx);
    return answer;
}

}  // namespace curvewall
