#include "calibration/formats/bourke_file.h"

#include "calibration/errors.h"
#include "calibration/formats/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace curvewall {
namespace {

constexpr int64_t kMostNodes = 16384;  // on each side
enum Type { kPolar = 1, kRectangular = 2 };

struct Node {
    double x, y, u, v, intensity;
};

struct Mesh {
    int64_t type = kRectangular;
    glm::ivec2 nodes{0};  // columns and rows
    std::vector<Node> values;
};

struct Head {
    int64_t type;
    TextLine typeLine, sizeLine;
    int64_t columns, rows;
};

// The first two lines, where they are as in no other format.
std::optional<Head> headOf(TextLines& lines) {
    const auto first = lines.next(), second = lines.next();
    if (!first || !second) return std::nullopt;
    const auto type = wholeNumberOf(first->text);
    const std::vector<std::string_view> sizes = wordsOf(second->text.substr(0, 64));
    if (!type || sizes.size() != 2) return std::nullopt;
    const auto columns = wholeNumberOf(sizes[0]), rows = wholeNumberOf(sizes[1]);
    if (!columns || !rows) return std::nullopt;
    return Head{*type, *first, *second, *columns, *rows};
}

void requireType(const FileBytes& file, const Head& head) {
    if (head.type == kRectangular || head.type == kPolar) return;
    throw InputError(
        file.path, "mesh type",
        "2 (rectangular) or 1 (polar): others bend pictures that are no fisheyes, in ways that their "
        "description does not fix",
        std::to_string(head.type));
}

Mesh readNodes(const FileBytes& file) {
    TextLines lines(file);
    const auto head = headOf(lines);
    if (!head) throw InputError(file.path, "", "a mesh type and then columns and rows", "other lines");
    requireType(file, *head);
    const auto isSide = [](int64_t count) { return count >= 2 && count <= kMostNodes; };
    if (!isSide(head->columns) || !isSide(head->rows))
        refuseLine(file, head->sizeLine, fmt::format("2 to {} columns and rows", kMostNodes));
    Mesh mesh{head->type, {static_cast<int>(head->columns), static_cast<int>(head->rows)}, {}};
    const auto count = static_cast<size_t>(head->columns * head->rows);
    while (const auto line = lines.next()) {
        const auto n = numbersOf(wordsOf(line->text), 5);
        if (!n) refuseLine(file, *line, "the five numbers x y u v i");
        if (mesh.values.size() == count) refuseLine(file, *line, fmt::format("no more than {} nodes", count));
        mesh.values.push_back({(*n)[0], (*n)[1], (*n)[2], (*n)[3], (*n)[4]});
    }
    if (mesh.values.size() != count)
        throw InputError(file.path, "", fmt::format("{} x {} nodes", head->columns, head->rows),
                         std::to_string(mesh.values.size()));
    return mesh;
}

double decideAspect(const FileBytes& file, const Mesh& mesh, Decisions& decisions) {
    double widest = 0;
    for (const Node& node : mesh.values)
        if (std::isfinite(node.x)) widest = std::max(widest, std::abs(node.x));
    constexpr Range kAspects{0.1, 10};
    if (!(widest >= kAspects.min && widest <= kAspects.max))
        throw InputError(file.path, "x", "positions from -aspect to aspect", fmt::format("up to {}", widest));
    return decisions.number("aspect", kAspects, widest, fmt::format("x reaches {} on the screen", widest));
}

}  // namespace

bool isBourkeFile(const FileBytes& file) {
    TextLines lines(file);
    return headOf(lines).has_value();
}

MeshCalibration readBourkeFile(const FileBytes& file, Decisions& decisions) {
    const Mesh read = readNodes(file);
    const double aspect = decideAspect(file, read, decisions);
    MeshCalibration mesh{.bendsFisheye = true, .aspect = aspect};
    // The columns of a polar mesh are angles: the last one meets the first.
    const glm::ivec2 nodes(read.nodes.x + (read.type == kPolar ? 1 : 0), read.nodes.y);
    for (int row = 0; row < nodes.y; ++row)
        for (int column = 0; column < nodes.x; ++column) {
            const Node& node = read.values[static_cast<size_t>(row) * static_cast<size_t>(read.nodes.x) +
                                           static_cast<size_t>(column % read.nodes.x)];
            const MeshVertex vertex{
                {(node.x / aspect + 1) / 2, (1 - node.y) / 2}, {node.u, 1 - node.v}, node.intensity};
            mesh.vertices.push_back(isWithinPicture(vertex.source) ? vertexIfValid(vertex) : std::nullopt);
        }
    mesh.cells =
        decideCells(nodes, CellCut::firstToLast, "SGCT cuts the cells of these meshes so", decisions);
    return mesh;
}

}  // namespace curvewall
