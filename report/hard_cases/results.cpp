#include "report/hard_cases/results.h"

#include "report/kept_json.h"
#include "report/speed_report_json.h"

#include <algorithm>

namespace curvewall {
namespace {

using nlohmann::json;

NLOHMANN_JSON_SERIALIZE_ENUM(Outcome, {{Outcome::drawn, "drawn"},
                                       {Outcome::refused, "refused"},
                                       {Outcome::failed, "failed"}})

json toJson(const CaseResult& r) {
    json to{{"value", r.value}, {"method", r.method}, {"outcome", r.outcome}};
    if (r.outcome != Outcome::drawn) {
        to["reason"] = r.reason;
        return to;
    }
    to["errors"] = r.errors;
    to["wrong_pixels"] = r.wrongPixels;
    to["gap_pixels"] = r.gapPixels;
    to["display_pixels"] = r.displayPixels;
    to["fault"] = r.fault;
    return to;
}

CaseResult caseResultFromJson(const json& from) {
    CaseResult r{from.at("value"), from.at("method"), from.at("outcome").get<Outcome>()};
    if (r.outcome != Outcome::drawn) {
        from.at("reason").get_to(r.reason);
        return r;
    }
    r.errors = from.at("errors").get<MethodErrors>();
    from.at("wrong_pixels").get_to(r.wrongPixels);
    from.at("gap_pixels").get_to(r.gapPixels);
    from.at("display_pixels").get_to(r.displayPixels);
    from.at("fault").get_to(r.fault);
    return r;
}

json toJson(const CaseTruth& t) {
    return {{"value", t.value},
            {"refusal", t.refusal},
            {"checked_pixels", t.check.checkedPixels},
            {"doubtful_pixels", t.check.doubtfulPixels},
            {"wrong_pixels", t.check.wrongPixels},
            {"geometric_px", t.geometricPx}};
}

CaseTruth caseTruthFromJson(const json& from) {
    return {from.at("value"),
            from.at("refusal"),
            {from.at("checked_pixels"), from.at("doubtful_pixels"), from.at("wrong_pixels")},
            numberOrInfinity(from.at("geometric_px"))};
}

}  // namespace

double CaseResult::faultyShare() const {
    const uint64_t most = std::max({wrongPixels, openPixels(), addedPixels(), errors.misplacedPixels});
    return displayPixels == 0 ? 0 : static_cast<double>(most) / static_cast<double>(displayPixels);
}

const CaseResult* FamilyResult::find(double value, const std::string& method) const {
    const auto found = std::ranges::find_if(
        results, [&](const CaseResult& r) { return r.value == value && r.method == method; });
    return found == results.end() ? nullptr : &*found;
}

std::string stemOf(std::string name) {
    std::erase(name, ',');
    std::ranges::replace(name, ' ', '-');
    return name;
}

json toJson(const FamilyResult& result) {
    json to{{"family", result.family},
            {"size_px", result.sizePx},
            {"truths", json::array()},
            {"results", json::array()},
            {"pictures", json::array()}};
    for (const CaseTruth& truth : result.truths) to["truths"].push_back(toJson(truth));
    for (const CaseResult& one : result.results) to["results"].push_back(toJson(one));
    for (const CasePicture& picture : result.pictures)
        to["pictures"].push_back({{"file", picture.file}, {"caption", picture.caption}});
    return to;
}

FamilyResult familyResultFromJson(const json& from) {
    FamilyResult result{from.at("family"), from.at("size_px"), {}, {}, {}};
    for (const json& truth : from.at("truths")) result.truths.push_back(caseTruthFromJson(truth));
    for (const json& one : from.at("results")) result.results.push_back(caseResultFromJson(one));
    for (const json& picture : from.at("pictures"))
        result.pictures.push_back({picture.at("file"), picture.at("caption")});
    return result;
}

}  // namespace curvewall
