#include "cli/option_checks.h"

#include "renderer/request_limits.h"

#include <fmt/core.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace curvewall {
namespace {

template <class Number>
std::optional<Number> numberIn(const std::string& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::string checkTolerance(std::string& text) {
    const auto px = numberIn<double>(text);
    if (px && *px >= kLeastTolerancePx && *px <= kMostTolerancePx) return "";
    return fmt::format("expected a number of pixels from {} to {}, found {}", kLeastTolerancePx,
                       kMostTolerancePx, text);
}

std::string checkTessellation(std::string& text) {
    const auto px = numberIn<double>(text);
    if (px && (*px == 0 || (*px >= kLeastTessellationPx && *px <= kMostTessellationPx))) return "";
    return fmt::format("expected 0 or a number of pixels from {} to {}, found {}", kLeastTessellationPx,
                       kMostTessellationPx, text);
}

std::string checkFaceSize(std::string& text) {
    const auto px = numberIn<int>(text);
    if (px && (*px == 0 || (*px >= kLeastFacePx && *px <= kMostFacePx))) return "";
    return fmt::format("expected 0 or a number of pixels from {} to {}, found {}", kLeastFacePx, kMostFacePx,
                       text);
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
