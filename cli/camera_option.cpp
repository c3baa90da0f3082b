#include "cli/camera_option.h"

#include "calibration/errors.h"
#include "calibration/readers/projection_fields.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace curvewall {
namespace {

// Every number between the commas, or nothing when one of them is none.
std::vector<double> numbersIn(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        double number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) return {};
        numbers.push_back(number);
        if (after == end) return numbers;
        if (*after != ',') return {};
        at = after + 1;
    }
}

}  // namespace

Camera cameraFromText(const std::string& text) {
    std::vector<double> numbers = numbersIn(text);
    if (numbers.size() < 3 || numbers.size() > 6)
        throw UsageError("--camera: expected x,y,z[,yaw,pitch,roll] in metres and degrees, found \"" + text +
                         "\"");
    numbers.resize(6, 0);
    return {{numbers[0], numbers[1], numbers[2]},
            {glm::radians(numbers[3]), glm::radians(numbers[4]), glm::radians(numbers[5])}};
}

glm::dvec3 eyeFromText(const std::string& text) {
    const std::vector<double> numbers = numbersIn(text);
    if (numbers.size() != 3 || std::ranges::any_of(numbers, [](double m) { return std::abs(m) > kMostM; }))
        throw UsageError("--eye: expected x,y,z in metres, each within " +
                         std::to_string(static_cast<int>(kMostM)) + ", found \"" + text + "\"");
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace curvewall
