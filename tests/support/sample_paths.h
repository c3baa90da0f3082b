#pragma once
// Where real scenes and calibrations lie that the project does not ship; tests that need them skip without.

#include <cstdlib>
#include <filesystem>
#include <string>

namespace curvewall::test {

// $CURVEWALL_SAMPLES, or shared/samples beside the source tree.
inline std::filesystem::path samplesFolder() {
    const char* folder = std::getenv("CURVEWALL_SAMPLES");
    return folder != nullptr ? std::filesystem::path(folder)
                             : std::filesystem::path(CURVEWALL_SOURCE_DIR) / ".." / "shared" / "samples";
}

inline std::filesystem::path scenesFolder() { return samplesFolder() / ".." / "scenes"; }

}  // namespace curvewall::test
