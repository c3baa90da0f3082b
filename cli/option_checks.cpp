#include "cli/option_checks.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/files/number_text.h"
#include "renderer/request_limits.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace curvewall {
std::string checkTolerance(std::string& text) {
    const auto px = numberFrom<double>(text);
    if (px && *px >= kLeastTolerancePx && *px <= kMostTolerancePx) return "";
    return fmt::format("expected a number of pixels from {} to {}, found {}", kLeastTolerancePx,
                       kMostTolerancePx, text);
}

std::string checkTessellation(std::string& text) {
    const auto px = numberFrom<double>(text);
    if (px && (*px == 0 || (*px >= kLeastTessellationPx && *px <= kMostTessellationPx))) return "";
    return fmt::format("expected 0 or a number of pixels from {} to {}, found {}", kLeastTessellationPx,
                       kMostTessellationPx, text);
}

std::string checkFaceSize(std::string& text) {
    const auto px = numberFrom<int>(text);
    if (px && (*px == 0 || (*px >= kLeastFacePx && *px <= kMostFacePx))) return "";
    return fmt::format("expected 0 or a number of pixels from {} to {}, found {}", kLeastFacePx, kMostFacePx,
                       text);
}

std::optional<glm::ivec2> countsFrom(const std::string& option, const std::string& expected,
                                     const std::string& text, int least) {
    if (text.empty()) return std::nullopt;
    const size_t cross = std::min(text.find('x'), text.size() - 1);
    const auto x = numberFrom<int>(text.substr(0, cross)), y = numberFrom<int>(text.substr(cross + 1));
    if (x && y && *x >= least && *x <= kMostPx && *y >= least && *y <= kMostPx) return glm::ivec2(*x, *y);
    throw UsageError(fmt::format("{}: expected {}, each from {} to {}, found \"{}\"", option, expected, least,
                                 kMostPx, text));
}

void requireFolderOf(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!path.empty() && !folder.empty() && !std::filesystem::is_directory(folder))
        throw std::runtime_error(path + ": there is no folder " + folder.string());
}

void makeFolder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!std::filesystem::is_directory(path))
        throw std::runtime_error(path + ": cannot be made a folder: " + error.message());
}

}  // namespace curvewall
