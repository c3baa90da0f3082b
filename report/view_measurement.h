#pragma once
// What is measured of one view, and kept in files that are named by its content.

#include "report/machine.h"
#include "report/measurement_plan.h"
#include "report/truth.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

enum class StepKind { truth, floor, errors, round, pictures };

struct Step {
    StepKind kind;
    std::string doing;
    bool isKept;                 // by an earlier run, so that it takes no time
    std::function<bool()> take;  // whether there was anything to do
};

// Takes little memory until its first step. View and plan have to outlive it.
class ViewMeasurement {
public:
    ViewMeasurement(const View& view, const MeasurementPlan& plan, const GlDriver& driver);

    // To be taken in their order.
    std::vector<Step> steps();

    // After them.
    ViewReport finish();

private:
    // In flat colours.
    struct FlatView {
        ScenePtr scene;
        Frame truth;
    };

    std::string pathOf(const std::string& what) const;
    std::string pathOfFloors() const;
    std::string pathOfErrors(size_t i) const;
    std::string pathOfRound(size_t i, int round) const;
    std::string keyOfErrors(size_t i) const;

    const FlatView& flat();
    RenderRequest requestOf(const Setting& setting);
    std::optional<SettingResult> keptErrors(size_t i) const;

    void findTruth();
    bool findFloors();
    bool findErrors(size_t i);
    bool takeRound(size_t i, int round);

    const View& view_;
    const MeasurementPlan& plan_;
    const Display& display_;
    Supersampling supersampling_;
    std::vector<Setting> settings_;
    std::string viewKey_;  // of the truth, which no driver has a part in
    std::string key_;      // of what the driver draws
    Renderer renderer_;
    std::optional<KnownTruth> truth_;
    std::optional<FlatView> flat_;
    std::map<double, std::shared_ptr<const FittedPieces>> pieces_;  // by their tolerance
    std::vector<std::vector<double>> rounds_;                       // of each setting
    ViewReport report_;
};

}  // namespace curvewall
