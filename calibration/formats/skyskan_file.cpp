#include "calibration/formats/skyskan_file.h"

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

constexpr int64_t kMostNodes = 16384;  // on each side

constexpr std::array<std::string_view, 8> kKeys{"dome azimuth", "dome elevation",   "horizontal fov",
                                                "vertical fov", "horizontal tweak", "vertical tweak",
                                                "u tweak",      "v tweak"};

struct SkySkan {
    std::map<std::string, double, std::less<>> values;
    std::optional<glm::ivec2> nodes;
    std::vector<std::array<double, 4>> vertices;

    std::optional<double> value(std::string_view key) const {
        const auto found = values.find(key);
        if (found == values.end()) return std::nullopt;
        return found->second;
    }
};

struct KeyAndValue {
    std::string key;  // in lower case
    std::string_view value;
};

std::optional<KeyAndValue> keyAndValueOf(const TextLine& line) {
    const std::vector<std::string_view> sides = fieldsOf(line.text.substr(0, 256), '=');
    if (sides.size() != 2) return std::nullopt;
    return KeyAndValue{lowerCase(std::string(sides[0])), sides[1]};
}

bool isKey(const std::string& key) { return std::ranges::find(kKeys, key) != kKeys.end(); }

void readKey(const FileBytes& file, const TextLine& line, const KeyAndValue& entry, SkySkan& mesh,
             Decisions& decisions) {
    constexpr size_t kMostWarnings = 16;
    if (!isKey(entry.key)) {
        if (decisions.warnings().size() < kMostWarnings)
            decisions.warn(fmt::format("{}: {} is not known", line.name(), quotedText(line.text)));
        return;
    }
    const auto number = numberOf(entry.value);
    if (!number || !std::isfinite(*number)) refuseLine(file, line, "a number");
    mesh.values[entry.key] = *number;
}

glm::ivec2 nodesOf(const FileBytes& file, const TextLine& line) {
    const std::vector<std::string_view> words = wordsOf(line.text);
    std::array<int, 2> nodes{};
    for (size_t i = 0; i < 2; ++i) {
        const auto count = words.size() == 2 ? wholeNumberOf(words[i]) : std::nullopt;
        if (!count || *count < 2 || *count > kMostNodes)
            refuseLine(file, line, fmt::format("2 to {} columns and rows", kMostNodes));
        nodes[i] = static_cast<int>(*count);
    }
    return {nodes[0], nodes[1]};
}

SkySkan readLines(const FileBytes& file, Decisions& decisions) {
    SkySkan mesh;
    TextLines lines(file);
    while (const auto line = lines.next()) {
        if (const auto entry = keyAndValueOf(*line)) {
            readKey(file, *line, *entry, mesh, decisions);
        } else if (!mesh.nodes) {
            mesh.nodes = nodesOf(file, *line);
        } else {
            const auto n = numbersOf(wordsOf(line->text), 4);
            if (!n) refuseLine(file, *line, "the four numbers x y u v");
            mesh.vertices.push_back({(*n)[0], (*n)[1], (*n)[2], (*n)[3]});
        }
    }
    const size_t expected =
        mesh.nodes ? static_cast<size_t>(mesh.nodes->x) * static_cast<size_t>(mesh.nodes->y) : 0;
    if (!mesh.nodes || mesh.vertices.size() != expected)
        throw InputError(file.path, "",
                         mesh.nodes ? fmt::format("{} x {} nodes", mesh.nodes->x, mesh.nodes->y)
                                    : "a line of columns and rows",
                         std::to_string(mesh.vertices.size()) + " lines of nodes");
    return mesh;
}

double requiredDeg(const FileBytes& file, const SkySkan& mesh, const char* key) {
    const auto value = mesh.value(key);
    if (!value) throw InputError(file.path, key, "an angle in degrees", "none");
    return *value;
}

double decideVerticalDeg(const SkySkan& mesh, double horizontalDeg, Decisions& decisions) {
    if (const auto given = mesh.value("vertical fov"); given && *given > 0) return *given;
    constexpr double kShape = 1200.0 / 2048.0;
    const double guessDeg = 2 * glm::degrees(std::atan(kShape * std::tan(glm::radians(horizontalDeg) / 2)));
    return decisions.number("vertical_fov_deg", {0, 180, true, true}, guessDeg,
                            "the file has none; Sky-Skan's displays had 2048 x 1200 pixels");
}

Frustum frustumOf(const FileBytes& file, const SkySkan& mesh, Decisions& decisions) {
    const double wideDeg = requiredDeg(file, mesh, "horizontal fov");
    if (!(wideDeg > 0 && wideDeg < 180))
        throw InputError(file.path, "horizontal fov", "degrees above 0, below 180",
                         fmt::format("{}", wideDeg));
    const double highDeg = decideVerticalDeg(mesh, wideDeg, decisions);
    const auto tweak = [&](const char* key) {
        const double factor = mesh.value(key).value_or(1);
        return factor > 0 ? factor : 1;
    };
    const double rightRad = glm::radians(wideDeg * tweak("horizontal tweak") / 2);
    const double upRad = glm::radians(highDeg * tweak("vertical tweak") / 2);
    const Orientation orientation{glm::radians(requiredDeg(file, mesh, "dome azimuth")),
                                  glm::radians(requiredDeg(file, mesh, "dome elevation")), 0};
    const Frustum frustum{-rightRad, rightRad, -upRad, upRad, orientation};
    requireFrustum(frustum, file);
    return frustum;
}

}  // namespace

bool isSkyskanFile(const FileBytes& file) {
    if (file.extension() == ".skyskan") return true;
    constexpr int kMostLinesAhead = 16;
    TextLines lines(file);
    for (int i = 0; i < kMostLinesAhead; ++i) {
        const auto line = lines.next();
        if (!line) return false;
        if (const auto entry = keyAndValueOf(*line); entry && isKey(entry->key)) return true;
    }
    return false;
}

MeshCalibration readSkyskanFile(const FileBytes& file, Decisions& decisions) {
    const SkySkan read = readLines(file, decisions);
    MeshCalibration mesh{.frustum = frustumOf(file, read, decisions)};
    const auto tweak = [&](const char* key) {
        const double factor = read.value(key).value_or(1);
        return factor > -1 ? factor : 1;
    };
    for (const auto& [x, y, u, v] : read.vertices) {
        const MeshVertex vertex{{x, y}, {u * tweak("u tweak"), v * tweak("v tweak")}};
        mesh.vertices.push_back(x == -1 || y == -1 ? std::nullopt : vertexIfValid(vertex));
    }
    mesh.cells =
        decideCells(*read.nodes, CellCut::firstToLast, "SGCT cuts the cells of these meshes so", decisions);
    return mesh;
}

}  // namespace curvewall
