#pragma once
// Checks of option values as CLI11 wants them: an empty text, or what is wrong.

#include <glm/vec2.hpp>

#include <optional>
#include <string>

namespace curvewall {

// Ranges as in renderer/request_limits.h. CLI11's own range check lets NaN pass.
std::string checkTolerance(std::string& text);
std::string checkTessellation(std::string& text);  // 0 or a length
std::string checkFaceSize(std::string& text);      // 0 or a size

// Two whole numbers with an x between them, from `least` to kMostPx; nothing for an empty text. Throws
// UsageError that names the option and what was `expected`.
std::optional<glm::ivec2> countsFrom(const std::string& option, const std::string& expected,
                                     const std::string& text, int least);

// Throws std::runtime_error unless the folder that `path` names a file in is there: before the work, not
// after it.
void requireFolderOf(const std::string& path);

// Throws std::runtime_error where there is no such folder and none can be made.
void makeFolder(const std::string& path);

}  // namespace curvewall
