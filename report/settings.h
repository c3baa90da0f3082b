#pragma once
// Which methods, with which knobs turned how far, a report measures.

#include "report/speed_report.h"

#include <vector>

namespace curvewall {

enum class Extent {
    quick,  // the methods that a user would choose between, few values each
    full,   // every method over its own knob
};

struct Setting {
    SettingName name;
    RenderRequest request;
    bool isShown = false;  // its picture is, beside the others
};

// Of one view: requests that differ from `base` in their method and its knobs. `auto` is none of them: it is
// one of the others, and which one may differ from run to run.
std::vector<Setting> settingsFor(const RenderRequest& base, Extent extent);

}  // namespace curvewall
