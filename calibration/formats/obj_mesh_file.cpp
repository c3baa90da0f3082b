#include "calibration/formats/obj_mesh_file.h"

#include "calibration/errors.h"
#include "calibration/formats/text_lines.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace curvewall {
namespace {

struct Corner {
    int64_t position, texture;  // from 0
};

struct Face {
    TextLine line;
    std::vector<Corner> corners;
};

struct Obj {
    std::vector<glm::dvec2> positions, textures;
    std::vector<Face> faces;
    std::set<std::string, std::less<>> unknown;
    bool hasDepth = false;
};

// Materials, groups, normals and the like say nothing of the mesh.
bool isIgnored(std::string_view word) {
    constexpr std::array<std::string_view, 10> kIgnored{"vn", "vp", "l",      "o",      "g",
                                                        "s",  "p",  "mtllib", "usemtl", "mg"};
    return word.starts_with('#') || std::ranges::find(kIgnored, word) != kIgnored.end();
}

glm::dvec2 pointOf(const FileBytes& file, const TextLine& line, const std::vector<std::string_view>& words) {
    const auto numbers = numbersOf({words.begin() + 1, words.end()}, words.size() - 1);
    if (!numbers || numbers->size() < 2) refuseLine(file, line, "two numbers or more");
    return {(*numbers)[0], (*numbers)[1]};
}

// From 1, or from the last one before the line backwards.
int64_t indexOf(const FileBytes& file, const TextLine& line, std::string_view text, size_t countBefore) {
    const auto index = wholeNumberOf(text);
    if (!index || *index == 0) refuseLine(file, line, "indices from 1, or negative ones");
    return *index > 0 ? *index - 1 : *index + static_cast<int64_t>(countBefore);
}

Corner cornerOf(const FileBytes& file, const TextLine& line, std::string_view word, const Obj& obj) {
    const std::vector<std::string_view> indices = fieldsOf(word, '/');
    if (indices.size() > 3 || (indices.size() > 1 && indices[1].empty()))
        refuseLine(file, line, "corners with texture coordinates: v/vt or v/vt/vn");
    return {indexOf(file, line, indices[0], obj.positions.size()),
            indexOf(file, line, indices[indices.size() > 1 ? 1 : 0], obj.textures.size())};
}

Face faceOf(const FileBytes& file, const TextLine& line, const std::vector<std::string_view>& words,
            const Obj& obj) {
    Face face{line, {}};
    for (size_t i = 1; i < words.size(); ++i) face.corners.push_back(cornerOf(file, line, words[i], obj));
    if (face.corners.size() < 3) refuseLine(file, line, "three corners or more");
    return face;
}

Obj readObj(const FileBytes& file) {
    Obj obj;
    TextLines lines(file);
    while (const auto line = lines.next()) {
        const std::vector<std::string_view> words = wordsOf(line->text);
        if (words[0] == "v") {
            obj.positions.push_back(pointOf(file, *line, words));
            obj.hasDepth |= words.size() > 3 && numberOf(words[3]) != 0.0;
        } else if (words[0] == "vt") {
            obj.textures.push_back(pointOf(file, *line, words));
        } else if (words[0] == "f") {
            obj.faces.push_back(faceOf(file, *line, words, obj));
        } else if (constexpr size_t kMostUnknown = 16;
                   !isIgnored(words[0]) && obj.unknown.size() < kMostUnknown) {
            obj.unknown.insert(quotedText(words[0]));
        }
    }
    if (obj.faces.empty()) throw InputError(file.path, "", "a mesh with faces", "none");
    return obj;
}

// Corners that name one position and one texture coordinate are one vertex.
class Vertices {
public:
    Vertices(const FileBytes& file, const Obj& obj, bool isNormalised)
        : file_(file), obj_(obj), isNormalised_(isNormalised) {}

    uint32_t numberOf(const Face& face, const Corner& corner) {
        const auto [entry, isNew] =
            numbers_.try_emplace({corner.position, corner.texture}, static_cast<uint32_t>(vertices_.size()));
        if (isNew) {
            const glm::dvec2 place = at(face, obj_.positions, "v", corner.position);
            const glm::dvec2 texture = at(face, obj_.textures, "vt", corner.texture);
            const glm::dvec2 screen = isNormalised_ ? (place + 1.0) / 2.0 : place;
            vertices_.push_back(vertexIfValid({{screen.x, 1 - screen.y}, {texture.x, 1 - texture.y}}));
        }
        return entry->second;
    }

    std::vector<std::optional<MeshVertex>> take() { return std::move(vertices_); }

private:
    glm::dvec2 at(const Face& face, const std::vector<glm::dvec2>& list, const char* name, int64_t i) const {
        if (i < 0 || static_cast<size_t>(i) >= list.size())
            refuseLine(file_, face.line, fmt::format("indices of the {} lines {}", list.size(), name));
        return list[static_cast<size_t>(i)];
    }

    const FileBytes& file_;
    const Obj& obj_;
    bool isNormalised_;
    std::map<std::pair<int64_t, int64_t>, uint32_t> numbers_;
    std::vector<std::optional<MeshVertex>> vertices_;
};

bool decideNormalised(const Obj& obj, Decisions& decisions) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec2 place : obj.positions) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const bool isWithin = glm::all(glm::greaterThanEqual(low, glm::dvec2(0)));
    return decisions.choose(
        "screen_units", {{"normalised", true}, {"fraction", false}}, !isWithin,
        fmt::format("x reaches from {} to {}, y from {} to {}", low.x, high.x, low.y, high.y));
}

}  // namespace

bool isObjMeshFile(const FileBytes& file) { return file.extension() == ".obj"; }

MeshCalibration readObjMeshFile(const FileBytes& file, Decisions& decisions) {
    const Obj obj = readObj(file);
    if (obj.hasDepth) decisions.warn("v: the third coordinate of some vertices is not 0; it is not used");
    for (const std::string& word : obj.unknown) decisions.warn("lines of " + word + " are not understood");
    Vertices vertices(file, obj, decideNormalised(obj, decisions));
    MeshCalibration mesh;
    for (const Face& face : obj.faces) {
        const uint32_t first = vertices.numberOf(face, face.corners[0]);
        for (size_t i = 2; i < face.corners.size(); ++i) {
            const uint32_t second = vertices.numberOf(face, face.corners[i - 1]);
            const uint32_t third = vertices.numberOf(face, face.corners[i]);
            mesh.cells.push_back({{first, second, third, 0}, CellShape::triangle});
        }
    }
    mesh.vertices = vertices.take();
    return mesh;
}

}  // namespace curvewall
