#pragma once
// Where the output of one display goes when a command writes for several.

#include "calibration/wall.h"

#include <string>
#include <vector>

namespace curvewall {

// `{display}` in the path is replaced by the display's name. Without it and with several displays,
// the name goes before the extension: FILE-NAME.ext. An empty path stays empty.
std::string pathForDisplay(const std::string& path, const std::string& display, bool severalDisplays);

// The named display, or all of them when the name is empty. Throws UsageError for a name that is not there.
std::vector<const Display*> chosenDisplays(const Wall& wall, const std::string& name);

}  // namespace curvewall
