#pragma once
// All settings of a view, with all that was measured.

#include "report/document.h"
#include "report/speed_report.h"

#include <string>

namespace curvewall {

// "1,673 pieces", "5 faces of 2,048 px", "–" where there is nothing to count.
std::string madeOfText(const SettingResult& result);

// Of those that can be drawn; `best`, if there is one, is emphasized.
Table settingsTable(const ViewReport& view, const SettingResult* best);

// Of settings that have stages; none may be.
Table stagesTable(const ViewReport& view);

}  // namespace curvewall
