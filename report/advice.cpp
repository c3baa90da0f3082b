#include "report/advice.h"

#include "report/recommendation.h"
#include "report/setting_tables.h"
#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

std::string timeText(const SettingResult& result) { return measureText(result.frameMs.median) + " ms"; }

// "3.1 times as long"
std::string comparedWith(const SettingResult& best, const SettingResult& other) {
    return timesText(other.frameMs.median / best.frameMs.median);
}

std::string withMade(const SettingResult& result) {
    const std::string made = madeOfText(result);
    return made == "–" ? "" : made + ", ";
}

std::string useText(const SettingResult& best) {
    std::string text = fmt::format("Use {}: {}{} a frame, at most {} off.", settingText(best.setting),
                                   withMade(best), timeText(best), pixelsText(best.errors.geometric.maxPx));
    if (const uint64_t faults = faultyPixels(best); faults > 0)
        text += fmt::format(" {} faulty {}.", countText(faults), faults == 1 ? "pixel" : "pixels");
    return text;
}

const SamplingFloor* floorOf(const ViewReport& view, int samples) {
    const auto floor = std::ranges::find(view.floors, samples, &SamplingFloor::samples);
    return floor == view.floors.end() ? nullptr : &*floor;
}

std::string wrongPixelsText(const ViewReport& view, const SettingResult& result) {
    std::string text = fmt::format("{} % of its pixels are wrong", percentText(result.errors.image.shareOff));
    if (const SamplingFloor* floor = floorOf(view, result.setting.samples))
        text += fmt::format("; an exact projection with the same sampling has {} %",
                            percentText(floor->shareOff));
    return text + ".";
}

std::string othersText(const Recommendation& answer, double tolerancePx) {
    if (answer.others.empty()) return fmt::format("No other method keeps {} here.", pixelsText(tolerancePx));
    std::string text =
        fmt::format("Of the other methods that keep {}, the next is ", pixelsText(tolerancePx));
    for (size_t i = 0; i < answer.others.size(); ++i) {
        const SettingResult& other = *answer.others[i];
        text += fmt::format("{}{}: {}, {}", i == 0 ? "" : "; then ", settingText(other.setting),
                            timeText(other), comparedWith(*answer.best, other));
    }
    return text + ".";
}

std::string halfErrorText(const Recommendation& answer, double tolerancePx) {
    if (!answer.halfError)
        return fmt::format("Nothing keeps half the error, {}.", pixelsText(tolerancePx / 2));
    if (answer.halfError == answer.best) return "It keeps half the error, too.";
    return fmt::format("Half the error, {}, costs {}: {}, {}.", pixelsText(tolerancePx / 2),
                       settingText(answer.halfError->setting), timeText(*answer.halfError),
                       comparedWith(*answer.best, *answer.halfError));
}

// Why the most exact setting of a method is not good enough.
std::string missText(const SettingResult& result) {
    std::string text = fmt::format("{} comes to {} in {}", settingText(result.setting),
                                   pixelsText(result.errors.geometric.maxPx), timeText(result));
    if (const uint64_t faults = faultyPixels(result); faults > 0)
        text += fmt::format(", with {} faulty {}", countText(faults), faults == 1 ? "pixel" : "pixels");
    return text;
}

std::string missingText(const Recommendation& answer, double tolerancePx) {
    std::string text =
        fmt::format("Not within {}, at the most exact that was measured: ", pixelsText(tolerancePx));
    for (size_t i = 0; i < answer.missing.size(); ++i)
        text += (i == 0 ? "" : "; ") + missText(*answer.missing[i]);
    return text + ".";
}

std::string refusingText(const Recommendation& answer) {
    std::string text;
    for (size_t i = 0; i < answer.refusing.size(); ++i)
        text += fmt::format("{}`{}`",
                            i == 0                            ? ""
                            : i + 1 == answer.refusing.size() ? " and "
                                                              : ", ",
                            answer.refusing[i]);
    return text + (answer.refusing.size() == 1 ? " does" : " do") +
           " not draw this display; the reason is below.";
}

void addAnswer(std::vector<Block>& blocks, const ViewReport& view, double tolerancePx) {
    const Recommendation answer = recommend(view, tolerancePx);
    blocks.emplace_back(Heading{3, viewName(view)});
    if (answer.best) {
        blocks.emplace_back(Paragraph{useText(*answer.best) + " " + wrongPixelsText(view, *answer.best)});
        blocks.emplace_back(List{{othersText(answer, tolerancePx), halfErrorText(answer, tolerancePx)}});
    } else {
        blocks.emplace_back(
            Paragraph{fmt::format("Nothing that was measured keeps {} here.", pixelsText(tolerancePx))});
        blocks.emplace_back(List{});
    }
    std::vector<std::string>& items = std::get<List>(blocks.back()).items;
    if (!answer.missing.empty()) items.push_back(missingText(answer, tolerancePx));
    if (!answer.refusing.empty()) items.push_back(refusingText(answer));
    if (items.empty()) blocks.pop_back();
}

Table summaryTable(const SpeedReport& report) {
    Table table{{"wall, display", "scene", "use", "error, px", "ms", "next method", "times as long"}, {}};
    for (const ViewReport& view : report.views) {
        const Recommendation answer = recommend(view, report.tolerancePx);
        std::vector<std::string> row{fmt::format("`{}`, `{}`", view.wall, view.display),
                                     "`" + view.scene + "`"};
        if (answer.best) {
            row.insert(row.end(),
                       {settingText(answer.best->setting), measureText(answer.best->errors.geometric.maxPx),
                        measureText(answer.best->frameMs.median)});
        } else {
            row.insert(row.end(), {"nothing keeps it", "–", "–"});
        }
        if (answer.best && !answer.others.empty()) {
            row.push_back(settingText(answer.others[0]->setting));
            row.push_back(
                fmt::format("{:.1f}", answer.others[0]->frameMs.median / answer.best->frameMs.median));
        } else {
            row.insert(row.end(), {"–", "–"});
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::vector<Block> adviceOf(const SpeedReport& report) {
    std::vector<Block> blocks;
    blocks.emplace_back(Heading{2, "Which method to use"});
    blocks.emplace_back(
        Paragraph{fmt::format("Asked for: a picture in which nothing is shown more than {} away from where "
                              "it belongs. Of all that keep this, the fastest.",
                              pixelsText(report.tolerancePx))});
    if (report.views.size() > 1) blocks.emplace_back(summaryTable(report));
    for (const ViewReport& view : report.views) addAnswer(blocks, view, report.tolerancePx);
    return blocks;
}

}  // namespace curvewall
