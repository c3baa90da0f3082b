#include "report/hard_cases/hard_cases_document.h"

#include "report/hard_cases/known_limits.h"
#include "report/hard_cases/methods.h"
#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace curvewall {
namespace {

// A family with what became of it.
struct Told {
    HardCaseFamily family;
    FamilyResult result;
    std::vector<std::string> methods;  // that were run, in their order

    const CaseResult& at(double value, const std::string& method) const {
        return *result.find(value, method);
    }
};

std::vector<Told> toldFamilies(const std::vector<FamilyResult>& results) {
    const std::vector<HardCaseFamily> families = hardCaseFamilies();
    std::vector<Told> all;
    for (const FamilyResult& result : results) {
        const auto family = std::ranges::find(families, result.family, &HardCaseFamily::name);
        if (family == families.end()) continue;
        Told told{*family, result, {}};
        for (const HardCaseMethod& method : hardCaseMethods())
            if (result.find(family->values.front(), method.name)) told.methods.push_back(method.name);
        all.push_back(std::move(told));
    }
    return all;
}

std::string numberText(double value) {
    if (std::isinf(value)) return "infinite";
    return measureText(value);
}

std::string valueText(double value) { return fmt::format("{:.7g}", value); }

// From where on a method is broken, or refuses.
struct Course {
    std::optional<double> brokenFrom, refusedFrom;
    bool isAllRefused = true;
};

Course courseOf(const Told& told, const std::string& method) {
    Course course;
    for (const double value : told.family.values) {
        const CaseResult& result = told.at(value, method);
        if (result.outcome == Outcome::refused) {
            if (!course.refusedFrom) course.refusedFrom = value;
            continue;
        }
        course.isAllRefused = false;
        if (result.isBroken() && !course.brokenFrom) course.brokenFrom = value;
    }
    return course;
}

std::string courseText(const Course& course) {
    if (course.isAllRefused) return "refused";
    std::string text = course.brokenFrom ? "breaks at " + valueText(*course.brokenFrom) : "";
    if (course.refusedFrom)
        text += (text.empty() ? "refused at " : ", refused at ") + valueText(*course.refusedFrom);
    return text.empty() ? "fine to the end" : text;
}

std::string cellText(const CaseResult& result) {
    if (result.outcome == Outcome::refused) return "refused";
    if (result.outcome == Outcome::failed) return "failed";
    std::string text = fmt::format("{} ({}) px", numberText(result.errors.geometric.maxPx),
                                   numberText(result.errors.geometric.p99Px));
    if (result.wrongPixels > 0)
        text += fmt::format(", {} % wrong", numberText(100 * static_cast<double>(result.wrongPixels) /
                                                       static_cast<double>(result.displayPixels)));
    if (result.errors.misplacedPixels > 0)
        text += fmt::format(", {} misplaced", result.errors.misplacedPixels);
    if (result.openPixels() > 0) text += fmt::format(", {} gaps", result.openPixels());
    if (result.addedPixels() > 0) text += fmt::format(", {} too many", result.addedPixels());
    return result.isBroken() ? "broken: " + text : text;
}

Table summaryTable(const std::vector<Told>& all) {
    Table table;
    table.columns = {"family"};
    for (const HardCaseMethod& method : hardCaseMethods()) table.columns.push_back(method.name);
    for (const Told& told : all) {
        std::vector<std::string>& row = table.rows.emplace_back();
        row.push_back(told.family.name);
        for (const HardCaseMethod& method : hardCaseMethods())
            row.push_back(std::ranges::find(told.methods, method.name) == told.methods.end()
                              ? "not run"
                              : courseText(courseOf(told, method.name)));
    }
    return table;
}

Table resultTable(const Told& told) {
    Table table;
    table.columns = {told.family.parameter};
    table.columns.insert(table.columns.end(), told.methods.begin(), told.methods.end());
    for (const double value : told.family.values) {
        std::vector<std::string>& row = table.rows.emplace_back();
        row.push_back(valueText(value));
        for (const std::string& method : told.methods) row.push_back(cellText(told.at(value, method)));
    }
    return table;
}

// Names have commas of their own.
std::string inWords(const std::vector<std::string>& names) {
    std::string text = names.front();
    for (size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? "; " : " and ") + names[i];
    return text;
}

// Where a method begins to break, and wherever no known limit explains it.
void tellBreaks(const Told& told, const std::string& method, List& list) {
    bool isFirst = true;
    for (const double value : told.family.values) {
        const CaseResult& result = told.at(value, method);
        if (!result.isBroken()) continue;
        const KnownLimit* const limit = knownLimitOf(told.family, result);
        if (isFirst || !limit)
            list.items.push_back(
                fmt::format("{} breaks at {}: {}. {}", method, valueText(value),
                            result.outcome == Outcome::failed ? result.reason : result.fault,
                            limit ? "Known: " + limit->why : "Not explained by any known limit."));
        isFirst = false;
    }
}

// Why each method stops where it stops, or is fine to the end.
List findings(const Told& told) {
    List list;
    std::vector<std::string> fine;
    std::set<std::string> wallRefusals;
    std::map<std::string, std::vector<std::string>>
        refusedBy;  // methods that draw none of it, by what they say
    for (const CaseTruth& truth : told.result.truths)
        if (!truth.refusal.empty() && wallRefusals.insert(truth.refusal).second)
            list.items.push_back("Refused at " + valueText(truth.value) + " for every method: \"" +
                                 truth.refusal + "\".");
    for (const std::string& method : told.methods) {
        const Course course = courseOf(told, method);
        tellBreaks(told, method, list);
        if (!course.brokenFrom && !course.isAllRefused) fine.push_back(method);
        if (course.isAllRefused)
            refusedBy[told.at(told.family.values.front(), method).reason].push_back(method);
        if (course.refusedFrom && !course.isAllRefused && wallRefusals.empty())
            list.items.push_back(fmt::format("{} refuses at {}: \"{}\".", method,
                                             valueText(*course.refusedFrom),
                                             told.at(*course.refusedFrom, method).reason));
    }
    for (const auto& [reason, methods] : refusedBy)
        list.items.push_back("Refused by " + inWords(methods) + ": \"" + reason + "\".");
    if (!fine.empty()) list.items.push_back("Fine wherever not refused: " + inWords(fine) + ".");
    return list;
}

std::optional<PlotFigure> errorPlot(const Told& told) {
    Plot plot{told.family.name, told.family.parameter, "largest geometric error, px", true, true, {}};
    double least = INFINITY, most = 0;
    size_t points = 0;
    for (const std::string& method : told.methods) {
        Curve curve{method, {}};
        for (const double value : told.family.values) {
            const CaseResult& result = told.at(value, method);
            const double errorPx = result.errors.geometric.maxPx;
            if (result.outcome != Outcome::drawn || !(value > 0) || !(errorPx > 0)) continue;
            curve.points.emplace_back(value, errorPx);
            least = std::min(least, value);
            most = std::max(most, value);
        }
        points = std::max(points, curve.points.size());
        if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
    }
    if (points < 3) return std::nullopt;
    plot.logarithmicX = most > 20 * least;
    return PlotFigure{plot,
                      {"hard-case-" + stemOf(told.family.name) + "-error.png",
                       "Largest geometric error by the " + told.family.parameter + "."}};
}

std::string truthText(const Told& told) {
    uint64_t checked = 0, doubtful = 0, wrong = 0;
    for (const CaseTruth& truth : told.result.truths) {
        checked += truth.check.checkedPixels;
        doubtful += truth.check.doubtfulPixels;
        wrong += truth.check.wrongPixels;
    }
    return fmt::format(
        "The truth: of {} pixels of the reference that were computed again in double precision, {} are "
        "wrong, and {} so near to an edge that none can tell.",
        checked, wrong, doubtful);
}

void tellFamily(const Told& told, std::vector<Block>& blocks) {
    blocks.emplace_back(Heading{2, told.family.name});
    blocks.emplace_back(Paragraph{told.family.what});
    blocks.emplace_back(resultTable(told));
    if (List list = findings(told); !list.items.empty()) blocks.emplace_back(std::move(list));
    blocks.emplace_back(Paragraph{truthText(told)});
    if (std::optional<PlotFigure> plot = errorPlot(told)) blocks.emplace_back(std::move(*plot));
    PictureRow row;
    for (const CasePicture& picture : told.result.pictures)
        row.pictures.push_back({picture.file, picture.caption});
    if (!row.pictures.empty()) blocks.emplace_back(std::move(row));
}

Table limitTable() {
    Table table{
        {"family", "method", "from", "off by at most, px", "99 in 100, px", "pixels at fault, %", "why"}, {}};
    for (const KnownLimit& limit : knownLimits())
        table.rows.push_back({limit.family, limit.methods.empty() ? "any" : limit.methods,
                              valueText(limit.from), numberText(limit.maxPx), numberText(limit.p99Px),
                              numberText(100 * limit.faultyShare), limit.why});
    return table;
}

std::vector<std::string> boundTexts() {
    std::vector<std::string> texts;
    for (const HardCaseMethod& method : hardCaseMethods()) {
        const StatedBounds& bounds = method.bounds;
        texts.push_back(bounds.maxPx == bounds.p99Px
                            ? fmt::format("{}: {:.3g} px at every pixel", method.name, bounds.maxPx)
                        : std::isinf(bounds.maxPx)
                            ? fmt::format("{}: {:.3g} px for 99 pixels in 100", method.name, bounds.p99Px)
                            : fmt::format("{}: {:.3g} px for 99 pixels in 100 and {:.3g} px for every one",
                                          method.name, bounds.p99Px, bounds.maxPx));
    }
    return texts;
}

}  // namespace

Document hardCasesDocument(const std::vector<FamilyResult>& results) {
    const std::vector<Told> all = toldFamilies(results);
    Document document{"Hard cases", {}};
    std::vector<Block>& blocks = document.blocks;
    const int sizePx = results.empty() ? 0 : results.front().sizePx;
    blocks.emplace_back(
        Paragraph{fmt::format("Geometry and displays that break renderers, in {} families, each from easy to "
                              "impossible, drawn by every method and compared with the reference. Displays "
                              "are {} px wide where the family does not say otherwise.",
                              all.size(), sizePx)});
    blocks.emplace_back(summaryTable(all));
    blocks.emplace_back(Heading{2, "What counts as broken"});
    blocks.emplace_back(Paragraph{
        "Where what a pixel shows belongs on the display, against the pixel's centre, may be off by"});
    blocks.emplace_back(List{boundTexts()});
    blocks.emplace_back(
        Paragraph{"and by what the reference itself is off, whose points too are told in single precision. A "
                  "picture is broken as well where colours or positions are not numbers; where a pixel shows "
                  "fewer surfaces than the truth has there and at all eight pixels around it (a gap); and "
                  "where more pixels than a quarter of the display's width and height have a colour that the "
                  "truth has nowhere within a pixel (wrong), show more surfaces than the truth has there "
                  "(too many), or show what the display has no place for. That many are left to chance, for "
                  "what is thinner than a pixel is met by a sample or not. Tables have the largest error, "
                  "that of 99 pixels in 100 in brackets, and such pixels where there are any."});
    blocks.emplace_back(
        Paragraph{"The truth is ray traced through the exact projection, with the rays of Embree in single "
                  "precision. So it is checked itself: every triangle is met once more with the rays of "
                  "pixels in double precision, of all pixels or, in large scenes, of evenly spread ones."});
    if (!knownLimits().empty()) {
        blocks.emplace_back(Heading{2, "Known limits"});
        blocks.emplace_back(Paragraph{
            "From which value of its family on a method breaks, and how badly at most, on displays of 100 px "
            "and of 512 px. Bounds are a fifth above what was measured; the tests hold them at 96 px, and at "
            "512 px for what only large displays show. Pixels at fault are those with the commonest fault."});
        blocks.emplace_back(limitTable());
    }
    for (const Told& told : all) tellFamily(told, blocks);
    return document;
}

}  // namespace curvewall
