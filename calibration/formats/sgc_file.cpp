#include "calibration/formats/sgc_file.h"

#include "calibration/errors.h"

#include <fmt/format.h>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace curvewall {
namespace {

constexpr std::string_view kMagic = "SGC";
constexpr size_t kTypeAt = 4, kViewAt = 8, kSizesAt = 52, kVerticesAt = 60;
constexpr size_t kVertexBytes = 24, kWordBytes = 4;

uint32_t wordAt(const FileBytes& file, size_t offset) {
    uint32_t word = 0;
    for (size_t i = kWordBytes; i-- > 0;)
        word = word << 8 | static_cast<unsigned char>(file.bytes[offset + i]);
    return word;
}

double floatAt(const FileBytes& file, size_t offset) {
    return static_cast<double>(std::bit_cast<float>(wordAt(file, offset)));
}

struct Layout {
    int version = 1;
    bool isStrip = true;
    size_t vertices = 0;
    size_t indices = 0;
    size_t indicesAt() const { return kVerticesAt + vertices * kVertexBytes + kWordBytes; }
};

void requireBytes(const FileBytes& file, const std::string& field, uint64_t expected,
                  const std::string& what) {
    if (file.bytes.size() < expected)
        throw InputError(file.path, field, fmt::format("{} in at least {} bytes", what, expected),
                         fmt::format("{} bytes", file.bytes.size()));
}

Layout layoutOf(const FileBytes& file) {
    requireBytes(file, "", kVerticesAt, "a header");
    Layout layout{.version = file.bytes[kMagic.size()]};
    if (layout.version != 1 && layout.version != 2)
        throw InputError(file.path, "version", "1 or 2", std::to_string(layout.version));
    const uint32_t type = wordAt(file, kTypeAt);
    if (type != 0)
        throw InputError(file.path, "type",
                         "0, a planar picture: how faces of a cube (1) are named is not known",
                         std::to_string(type));
    const uint64_t first = wordAt(file, kSizesAt), second = wordAt(file, kSizesAt + kWordBytes);
    layout.isStrip = layout.version == 1 || first != 4;
    const uint64_t vertices = layout.version == 1 ? first * second : second;  // two words: no overflow
    const std::string sizes = fmt::format("{} vertices", vertices);
    if (vertices > file.bytes.size()) requireBytes(file, "size", vertices, sizes);
    requireBytes(file, "size", kVerticesAt + vertices * kVertexBytes + kWordBytes, sizes);
    layout.vertices = vertices;
    layout.indices = wordAt(file, kVerticesAt + layout.vertices * kVertexBytes);
    const uint64_t end = layout.indicesAt() + uint64_t{layout.indices} * kWordBytes;
    if (end != file.bytes.size())
        throw InputError(file.path, "indices",
                         fmt::format("{} of them, so that the file has {} bytes", layout.indices, end),
                         fmt::format("{} bytes", file.bytes.size()));
    return layout;
}

Frustum frustumOf(const FileBytes& file, Decisions& decisions) {
    const auto view = [&](size_t i) { return floatAt(file, kViewAt + i * kWordBytes); };
    const glm::dquat q(view(3), view(0), view(1), view(2));
    const double length = glm::length(q);
    if (!(std::abs(length - 1) < 0.01))
        throw InputError(file.path, "quaternion", "a rotation, whose length is 1",
                         fmt::format("({}, {}, {}, {})", q.x, q.y, q.z, q.w));
    if (view(4) != 0 || view(5) != 0 || view(6) != 0)
        decisions.warn(fmt::format("position: ({}, {}, {}) is not used: the wall has one eye", view(4),
                                   view(5), view(6)));
    const Frustum frustum{glm::radians(view(9)), glm::radians(view(10)), glm::radians(view(8)),
                          glm::radians(view(7)), orientationFromRotation(glm::mat3_cast(q / length))};
    requireFrustum(frustum, file);
    return frustum;
}

std::vector<std::optional<MeshVertex>> verticesOf(const FileBytes& file, const Layout& layout) {
    std::vector<std::optional<MeshVertex>> vertices;
    for (size_t i = 0; i < layout.vertices; ++i) {
        const auto number = [&](size_t component) {
            return floatAt(file, kVerticesAt + i * kVertexBytes + component * kWordBytes);
        };
        // Real meshes reach beyond the screen by up to 8 per cent. SGCT clamps them to it, which bends what
        // is seen along the border.
        vertices.push_back(vertexIfValid({{number(0), number(1)}, {number(3), 1 - number(4)}}));
    }
    return vertices;
}

std::vector<uint32_t> indicesOf(const FileBytes& file, const Layout& layout) {
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < layout.indices; ++i) {
        indices.push_back(wordAt(file, layout.indicesAt() + i * kWordBytes));
        if (indices.back() >= layout.vertices)
            throw InputError(file.path, fmt::format("indices[{}]", i),
                             fmt::format("less than {}", layout.vertices), std::to_string(indices.back()));
    }
    const bool fits = layout.isStrip ? indices.size() >= 3 : !indices.empty() && indices.size() % 3 == 0;
    if (!fits)
        throw InputError(file.path, "indices",
                         layout.isStrip ? "a strip of triangles" : "threes for triangles",
                         fmt::format("{} of them", indices.size()));
    return indices;
}

// The strip's first two indices lie below one another.
std::optional<glm::ivec2> gridOf(const std::vector<uint32_t>& indices, const Layout& layout) {
    if (!layout.isStrip || indices[0] != 0) return std::nullopt;
    const size_t columns = indices[1];
    if (columns < 2 || layout.vertices % columns != 0 || layout.vertices == columns) return std::nullopt;
    if (layout.vertices > static_cast<size_t>(std::numeric_limits<int>::max())) return std::nullopt;
    return glm::ivec2(static_cast<int>(columns), static_cast<int>(layout.vertices / columns));
}

// Strips of SGCT's converters end with a row that runs backwards, one index short of its last half cell. The
// same grids in other formats have no hole there.
bool lacksItsEnd(const std::vector<uint32_t>& indices, glm::ivec2 grid) {
    const auto columns = static_cast<uint32_t>(grid.x), rows = static_cast<uint32_t>(grid.y);
    return indices.back() == (rows - 2) * columns && indices[indices.size() - 2] == (rows - 1) * columns + 1;
}

// Where a strip turns at a border of the grid it goes through triangles of no area: with a vertex twice, or
// with all three along the border.
bool isTurn(uint32_t a, uint32_t b, uint32_t c, std::optional<glm::ivec2> grid) {
    if (a == b || b == c || a == c) return true;
    if (!grid) return false;
    const auto columns = static_cast<uint32_t>(grid->x);
    return (a % columns == b % columns && b % columns == c % columns) ||
           (a / columns == b / columns && b / columns == c / columns);
}

std::vector<WarpCell> listedTriangles(const std::vector<uint32_t>& indices, const Layout& layout,
                                      std::optional<glm::ivec2> grid) {
    std::vector<WarpCell> cells;
    for (size_t i = 0; i + 2 < indices.size(); i += layout.isStrip ? 1 : 3) {
        const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (!isTurn(a, b, c, grid)) cells.push_back({{a, b, c, 0}, CellShape::triangle});
    }
    return cells;
}

}  // namespace

bool isSgcFile(const FileBytes& file) { return file.bytes.starts_with(kMagic); }

MeshCalibration readSgcFile(const FileBytes& file, Decisions& decisions) {
    const Layout layout = layoutOf(file);
    MeshCalibration mesh{.vertices = verticesOf(file, layout), .frustum = frustumOf(file, decisions)};
    std::vector<uint32_t> indices = indicesOf(file, layout);
    const auto grid = gridOf(indices, layout);
    if (grid && lacksItsEnd(indices, *grid) &&
        decisions.choose("strip_end", {{"completed", true}, {"as_listed", false}}, true,
                         "the strip covers its grid but for the half of the last cell"))
        indices.push_back(static_cast<uint32_t>((grid->y - 1) * grid->x));
    const bool isBilinear =
        grid && decisions.choose("interpolation", {{"triangles_listed", false}, {"bilinear", true}}, false,
                                 "the file lists its triangles");
    mesh.cells = isBilinear ? quadrilateralsOfGrid(*grid) : listedTriangles(indices, layout, grid);
    return mesh;
}

}  // namespace curvewall
