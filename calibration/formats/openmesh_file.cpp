#include "calibration/formats/openmesh_file.h"

#include "calibration/errors.h"
#include "calibration/formats/text_lines.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace curvewall {
namespace {

constexpr std::string_view kMagic = "OPENMESH";

constexpr std::array<std::string_view, 17> kNumberKeys{
    "ORTHO_LEFT",          "ORTHO_RIGHT",         "ORTHO_TOP",
    "ORTHO_BOTTOM",        "PERSPECTIVE_XOFFSET", "PERSPECTIVE_YOFFSET",
    "PERSPECTIVE_ZOFFSET", "PERSPECTIVE_ROLL",    "PERSPECTIVE_PITCH",
    "PERSPECTIVE_YAW",     "PERSPECTIVE_LEFT",    "PERSPECTIVE_RIGHT",
    "PERSPECTIVE_TOP",     "PERSPECTIVE_BOTTOM",  "GAMMA",
    "NATIVEXRES",          "NATIVEYRES"};
constexpr std::array<std::string_view, 3> kCountKeys{"VERTICES", "FACES", "DO_NO_WARP"};
// Switches of what we do not do; 0 is off.
constexpr std::array<std::string_view, 5> kSwitchKeys{"USE_SPHERE_SAMPLE_COORDINATE_SYSTEM",
                                                      "FRUSTUM_EULER_ANGLES", "APPLY_MASK",
                                                      "APPLY_BLACK_LEVEL", "APPLY_COLOR"};
constexpr std::array<std::string_view, 7> kTextKeys{
    "SUBVERSION",        "LABEL", "SAMPLING", "PROJECTION", "FRUSTUM_EULER_YAW", "FRUSTUM_EULER_PITCH",
    "FRUSTUM_EULER_ROLL"};

template <size_t size>
bool isAmong(std::string_view word, const std::array<std::string_view, size>& words) {
    return std::ranges::find(words, word) != words.end();
}

struct OpenMesh {
    std::map<std::string, double, std::less<>> numbers;
    std::map<std::string, int64_t, std::less<>> counts;
    std::vector<std::array<double, 5>> vertices;
    std::vector<std::array<uint32_t, 3>> faces;

    double number(std::string_view key, double otherwise) const {
        const auto found = numbers.find(key);
        return found == numbers.end() ? otherwise : found->second;
    }
    bool has(std::string_view key) const { return numbers.contains(key); }
};

void readKey(const FileBytes& file, const TextLine& line, std::string_view key, std::string_view value,
             OpenMesh& mesh, Decisions& decisions) {
    if (isAmong(key, kNumberKeys)) {
        const auto number = numberOf(value);
        if (!number || !std::isfinite(*number)) refuseLine(file, line, "a number");
        mesh.numbers[std::string(key)] = *number;
    } else if (isAmong(key, kCountKeys) || isAmong(key, kSwitchKeys)) {
        const auto count = wholeNumberOf(value);
        if (!count || *count < 0) refuseLine(file, line, "a whole number");
        mesh.counts[std::string(key)] = *count;
        if (isAmong(key, kSwitchKeys) && *count != 0)
            decisions.warn(fmt::format("{}: {} is on, which is not supported", line.name(), key));
    } else if (key == "MAPPING" && value != "NORMALIZED") {
        throw InputError(file.path, line.name(), "MAPPING NORMALIZED", quotedText(line.text));
    } else if (key != kMagic && key != "MAPPING" && !isAmong(key, kTextKeys)) {
        constexpr size_t kMostWarnings = 16;
        if (decisions.warnings().size() < kMostWarnings)
            decisions.warn(fmt::format("{}: the key {} is not known", line.name(), quotedText(key)));
    }
}

std::array<uint32_t, 3> faceOf(const FileBytes& file, const TextLine& line) {
    std::string_view text = line.text;
    text.remove_prefix(1);
    if (text.ends_with(']')) text.remove_suffix(1);
    const std::vector<std::string_view> words = wordsOf(text);
    std::array<uint32_t, 3> face{};
    for (size_t i = 0; i < 3; ++i) {
        const auto index = words.size() == 3 ? wholeNumberOf(words[i]) : std::nullopt;
        if (!index || *index < 0 || *index > UINT32_MAX) refuseLine(file, line, "[ a b c ], three vertices");
        face[i] = static_cast<uint32_t>(*index);
    }
    return face;
}

OpenMesh readLines(const FileBytes& file, Decisions& decisions) {
    OpenMesh mesh;
    TextLines lines(file);
    while (const auto line = lines.next()) {
        const std::vector<std::string_view> words = wordsOf(line->text);
        if (words[0].starts_with('[')) {
            mesh.faces.push_back(faceOf(file, *line));
        } else if (numberOf(words[0])) {
            const auto n = numbersOf(words, 5);
            if (!n) refuseLine(file, *line, "the five numbers x y intensity s t");
            mesh.vertices.push_back({(*n)[0], (*n)[1], (*n)[2], (*n)[3], (*n)[4]});
        } else {
            readKey(file, *line, words[0], words.size() > 1 ? words[1] : std::string_view(), mesh, decisions);
        }
    }
    return mesh;
}

void requireCount(const FileBytes& file, const OpenMesh& mesh, const char* key, size_t found) {
    const auto count = mesh.counts.find(key);
    if (count != mesh.counts.end() && static_cast<uint64_t>(count->second) == found) return;
    throw InputError(file.path, key,
                     count == mesh.counts.end() ? "their number" : std::to_string(count->second),
                     std::to_string(found) + " lines");
}

glm::ivec2 nativeSize(const FileBytes& file, const OpenMesh& mesh) {
    const auto side = [&](const char* key) {
        const double px = mesh.number(key, 0);
        if (px < 1 || px > 16384 || px != std::floor(px))
            throw InputError(file.path, key, "1 to 16384 pixels",
                             mesh.has(key) ? fmt::format("{}", px) : "none");
        return static_cast<int>(px);
    };
    return {side("NATIVEXRES"), side("NATIVEYRES")};
}

// World from view.
glm::dmat3 decideRotation(const Orientation& angles, Decisions& decisions) {
    if (angles == Orientation{}) return glm::dmat3(1);
    const bool likeSgct = decisions.choose(
        "rotation", {{"roll_yaw_pitch", true}, {"yaw_pitch_roll", false}}, true,
        "SGCT turns by roll, then yaw to the left, then pitch; the format is described nowhere");
    if (!likeSgct) return rotationFromOrientation(angles);
    return rotationFromOrientation({0, 0, -angles.rollRad}) *
           rotationFromOrientation({-angles.yawRad, 0, 0}) * rotationFromOrientation({0, angles.pitchRad, 0});
}

std::optional<Frustum> frustumOf(const FileBytes& file, const OpenMesh& mesh, Decisions& decisions) {
    const auto angleRad = [&](const char* key) { return glm::radians(mesh.number(key, 0)); };
    for (const char* key : {"PERSPECTIVE_XOFFSET", "PERSPECTIVE_YOFFSET", "PERSPECTIVE_ZOFFSET"})
        if (mesh.number(key, 0) != 0)
            decisions.warn(fmt::format("{} is {}, which is not used: the picture is taken to be far away",
                                       key, mesh.number(key, 0)));
    if (!mesh.has("PERSPECTIVE_LEFT") && !mesh.has("PERSPECTIVE_RIGHT") && !mesh.has("PERSPECTIVE_TOP") &&
        !mesh.has("PERSPECTIVE_BOTTOM"))
        return std::nullopt;
    const Orientation angles{angleRad("PERSPECTIVE_YAW"), angleRad("PERSPECTIVE_PITCH"),
                             angleRad("PERSPECTIVE_ROLL")};
    const Frustum frustum{angleRad("PERSPECTIVE_LEFT"), angleRad("PERSPECTIVE_RIGHT"),
                          angleRad("PERSPECTIVE_BOTTOM"), angleRad("PERSPECTIVE_TOP"),
                          orientationFromRotation(decideRotation(angles, decisions))};
    requireFrustum(frustum, file);
    return frustum;
}

// Fractions of what is between two bounds.
double fractionOf(const FileBytes& file, const OpenMesh& mesh, double value, const char* low,
                  const char* high) {
    const double lowest = mesh.number(low, 0), highest = mesh.number(high, 1);
    if (!(std::abs(highest - lowest) > 1e-9))
        throw InputError(file.path, high, std::string("another number than ") + low,
                         fmt::format("{}", highest));
    return (value - lowest) / (highest - lowest);
}

}  // namespace

bool isOpenmeshFile(const FileBytes& file) {
    const auto first = TextLines(file).next();
    return first && (first->text == kMagic || first->text.starts_with(std::string(kMagic) + " "));
}

MeshCalibration readOpenmeshFile(const FileBytes& file, Decisions& decisions) {
    const OpenMesh read = readLines(file, decisions);
    requireCount(file, read, "VERTICES", read.vertices.size());
    requireCount(file, read, "FACES", read.faces.size());
    const glm::ivec2 size = nativeSize(file, read);
    MeshCalibration mesh{.frustum = frustumOf(file, read, decisions), .sizePx = size};
    if (read.has("GAMMA")) mesh.intensityGamma = read.number("GAMMA", 0);
    const bool isUp =
        decisions.choose("screen_y", {{"up", true}, {"down", false}}, true, "SGCT draws y upwards");
    const bool isSwapped = decisions.choose("source_axes", {{"swapped", true}, {"plain", false}}, true,
                                            "SGCT takes 1 - t to the right and 1 - s upwards");
    const bool isUnwarped = read.counts.contains("DO_NO_WARP") && read.counts.at("DO_NO_WARP") != 0;
    for (const auto& [x, y, intensity, s, t] : read.vertices) {
        const double right = fractionOf(file, read, x / size.x, "ORTHO_LEFT", "ORTHO_RIGHT");
        const double up = fractionOf(file, read, y / size.y, "ORTHO_BOTTOM", "ORTHO_TOP");
        const glm::dvec2 screen(right, isUp ? 1 - up : up);
        const glm::dvec2 source = isSwapped ? glm::dvec2(1 - t, s) : glm::dvec2(s, 1 - t);
        mesh.vertices.push_back(vertexIfValid({screen, isUnwarped ? screen : source, intensity / 255}));
    }
    for (const auto& [a, b, c] : read.faces) {
        if (std::max({a, b, c}) >= read.vertices.size())
            throw InputError(file.path, "FACES", fmt::format("vertices below {}", read.vertices.size()),
                             fmt::format("[ {} {} {} ]", a, b, c));
        mesh.cells.push_back({{a, b, c, 0}, CellShape::triangle});
    }
    return mesh;
}

}  // namespace curvewall
