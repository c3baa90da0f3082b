#include "calibration/formats/domeprojection_file.h"

#include "calibration/errors.h"
#include "calibration/formats/text_lines.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

constexpr std::string_view kHeader = "x;y;u;v;column;row";
constexpr int64_t kMostNodes = 16384;  // on each side

struct Row {
    glm::ivec2 node{0};
    MeshVertex vertex;
};

std::string headerOf(const TextLine& line) {
    std::string header;
    for (const std::string_view field : fieldsOf(line.text, ';'))
        header += (header.empty() ? "" : ";") + lowerCase(std::string(field));
    return header;
}

Row rowOf(const FileBytes& file, const TextLine& line) {
    const std::vector<std::string_view> fields = fieldsOf(line.text, ';');
    if (fields.size() == 6) {
        const auto numbers = numbersOf({fields.begin(), fields.begin() + 4}, 4);
        const auto column = wholeNumberOf(fields[4]), row = wholeNumberOf(fields[5]);
        const auto isNode = [](std::optional<int64_t> i) { return i && *i >= 0 && *i < kMostNodes; };
        if (numbers && isNode(column) && isNode(row))
            return {{static_cast<int>(*column), static_cast<int>(*row)},
                    {{(*numbers)[0], (*numbers)[1]}, {(*numbers)[2], (*numbers)[3]}}};
    }
    refuseLine(file, line,
               fmt::format("four numbers, a column and a row below {}, separated by ;", kMostNodes));
}

}  // namespace

bool isDomeprojectionFile(const FileBytes& file) {
    const auto first = TextLines(file).next();
    return first && first->text.size() < 256 && headerOf(*first).starts_with("x;y;u;v");
}

MeshCalibration readDomeprojectionFile(const FileBytes& file, Decisions& decisions) {
    TextLines lines(file);
    const auto header = lines.next();
    if (!header || headerOf(*header) != kHeader)
        throw InputError(file.path, "line 1", std::string(kHeader),
                         header ? quotedText(header->text) : "nothing");
    std::vector<Row> rows;
    glm::ivec2 last(0);
    while (const auto line = lines.next()) {
        rows.push_back(rowOf(file, *line));
        last = glm::max(last, rows.back().node);
    }
    const glm::ivec2 nodes = last + 1;
    const size_t count = static_cast<size_t>(nodes.x) * static_cast<size_t>(nodes.y);
    // Rows may be missing, but a few lines must not ask for a large grid.
    constexpr size_t kMostNodesPerRow = 16;
    if (nodes.x < 2 || nodes.y < 2 || count / kMostNodesPerRow > rows.size())
        throw InputError(file.path, "column, row", "a grid of 2 x 2 nodes or more, most of them present",
                         fmt::format("{} of {} x {}", rows.size(), nodes.x, nodes.y));

    MeshCalibration mesh;
    mesh.vertices.resize(count);
    std::vector<bool> isThere(count);
    std::optional<glm::ivec2> repeated;
    for (const Row& row : rows) {
        const size_t i =
            static_cast<size_t>(row.node.y) * static_cast<size_t>(nodes.x) + static_cast<size_t>(row.node.x);
        if (isThere[i] && !repeated) repeated = row.node;
        isThere[i] = true;
        mesh.vertices[i] = vertexIfValid(row.vertex);
    }
    if (repeated)
        decisions.warn(fmt::format("column {}, row {} is there more than once: the last one counts",
                                   repeated->x, repeated->y));
    mesh.cells = decideCells(
        nodes, CellCut::alternating,
        "nothing in the file says; the strips of the same grids as .sgc and .simcad run to and fro",
        decisions);
    return mesh;
}

}  // namespace curvewall
