#include "calibration/formats/frustum_file.h"

#include "calibration/errors.h"
#include "calibration/formats/mesh_calibration.h"
#include "calibration/formats/text_lines.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <map>
#include <string>

namespace curvewall {
namespace {

constexpr double kSameTangent = 1e-4;  // files have their angles to five digits or more

using Values = std::map<std::string, double, std::less<>>;

Values valuesOf(const FileBytes& file) {
    TextLines lines(file);
    const auto header = lines.next(), line = lines.next();
    if (!header || !line)
        throw InputError(file.path, "", "a line of names and a line of values",
                         header ? "one line" : "nothing");
    const std::vector<std::string_view> names = fieldsOf(header->text, ';');
    const auto numbers = numbersOf(fieldsOf(line->text, ';'), names.size());
    if (!numbers) refuseLine(file, *line, fmt::format("{} numbers separated by ;", names.size()));
    Values values;
    for (size_t i = 0; i < names.size(); ++i) values[lowerCase(std::string(names[i]))] = (*numbers)[i];
    return values;
}

double required(const FileBytes& file, const Values& values, const char* name) {
    const auto found = values.find(name);
    if (found == values.end() || !std::isfinite(found->second))
        throw InputError(file.path, name, "a number",
                         found == values.end() ? "none" : "one that is not finite");
    return found->second;
}

// Degrees, as the file has them.
struct Sides {
    double left = 0, right = 0, bottom = 0, top = 0;
};

double tangent(double deg) { return std::tan(glm::radians(deg)); }

// Without a width that decides, left does: it is left of the axis in nearly every picture. Height decides
// nothing, since the angle of the bottom is of either sign in both kinds of file, and SGCT's exports subtract
// magnitudes.
bool decideSigned(const Values& values, const Sides& sides, Decisions& decisions) {
    bool isSigned = sides.left < 0 || (sides.left == 0 && sides.bottom < 0);
    std::string evidence =
        fmt::format("left is {}, right {}, bottom {}", sides.left, sides.right, sides.bottom);
    if (const auto width = values.find("width"); width != values.end()) {
        const double difference = tangent(sides.right) - tangent(sides.left);
        const double sum = tangent(sides.right) + tangent(sides.left);
        const auto fits = [&](double tan) {
            return tan > kSameTangent && std::abs(tan - width->second) < kSameTangent;
        };
        if (fits(difference) != fits(sum)) isSigned = fits(difference);
        evidence += fmt::format(", width {} where the tangents differ by {:.6f} and add up to {:.6f}",
                                width->second, difference, sum);
    }
    return decisions.choose("angle_signs", {{"signed", true}, {"magnitudes", false}}, isSigned, evidence);
}

void compareTangents(const Values& values, const Sides& sides, Decisions& decisions) {
    const auto compare = [&](const char* name, double deg) {
        const auto found = values.find(name);
        if (found != values.end() && std::abs(found->second - tangent(deg)) > kSameTangent)
            decisions.warn(
                fmt::format("frustum: {} is {}, but the angle's tangent is {:.6f}: the angle counts", name,
                            found->second, tangent(deg)));
    };
    compare("tanleft", sides.left);
    compare("tanright", sides.right);
    compare("tanbottom", sides.bottom);
    compare("tantop", sides.top);
}

std::string usualName(const FileBytes& mesh) {
    constexpr std::string_view kMesh = "_mesh";
    std::string stem = mesh.stem();
    if (lowerCase(stem).ends_with(kMesh)) stem.resize(stem.size() - kMesh.size());
    return stem + "_frustum.csv";
}

}  // namespace

bool isFrustumFile(const FileBytes& file) {
    return lowerCase(file.bytes.substr(0, 128)).find("x;y;z;heading;pitch;bank;") != std::string::npos;
}

Frustum readFrustumFile(const FileBytes& file, Decisions& decisions) {
    const Values values = valuesOf(file);
    const auto number = [&](const char* name) { return required(file, values, name); };
    const Sides sides{number("left"), number("right"), number("bottom"), number("top")};
    compareTangents(values, sides, decisions);
    for (const char* axis : {"x", "y", "z"})
        if (const auto at = values.find(axis); at != values.end() && at->second != 0)
            decisions.warn(
                fmt::format("frustum: {} is {}, which is not used: the wall has one eye", axis, at->second));
    const double sign = decideSigned(values, sides, decisions) ? 1 : -1;
    const Frustum frustum{
        glm::radians(sign * sides.left),
        glm::radians(sides.right),
        glm::radians(sign * sides.bottom),
        glm::radians(sides.top),
        {glm::radians(number("heading")), glm::radians(number("pitch")), glm::radians(number("bank"))}};
    requireFrustum(frustum, file);
    return frustum;
}

std::optional<Frustum> frustumBeside(const FileBytes& mesh, const FindFile& find, Decisions& decisions) {
    const std::string usual = usualName(mesh);
    const bool isThere = find(usual).has_value();
    const std::string name = decisions.text("frustum_file", isThere ? usual : "",
                                            isThere ? "it lies beside the mesh" : "there is no " + usual);
    if (name.empty()) return std::nullopt;
    const auto file = find(name);
    if (!file)
        throw InputError(mesh.path, "frustum_file", "a file beside the mesh",
                         "none named " + quotedText(name));
    return readFrustumFile(*file, decisions);
}

}  // namespace curvewall
