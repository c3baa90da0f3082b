#include "calibration/formats/simcad_file.h"

#include "calibration/errors.h"
#include "calibration/files/xml_document.h"
#include "calibration/formats/text_lines.h"

#include <cmath>
#include <utility>

namespace curvewall {
namespace {

struct Offsets {
    double rangePx = 1;
    std::vector<double> offsetsPx;
};

Offsets readOffsets(const XmlElement& definition, const char* name) {
    const auto element = definition.child(name);
    if (!element) throw definition.error(std::string("an element ") + name, "none");
    const auto range = element->attributeNumber("range");
    if (!range || !(*range > 0))
        throw element->error("an attribute range above 0", range ? "another" : "none");
    Offsets read{*range, {}};
    const std::string text = element->text();
    for (const std::string_view word : wordsOf(text)) {
        const auto number = numberOf(word);
        if (!number) throw element->error("numbers", quotedText(word));
        read.offsetsPx.push_back(*number);
    }
    return read;
}

// What offsets are counted in: pixels of the whole display.
std::optional<glm::ivec2> sizeOf(double x, double y) {
    const auto isSize = [](double range) { return range == std::floor(range) && range <= 16384; };
    if (!isSize(x) || !isSize(y)) return std::nullopt;
    return glm::ivec2(static_cast<int>(x), static_cast<int>(y));
}

int sideOf(const XmlElement& definition, const Offsets& x, const Offsets& y) {
    const size_t count = x.offsetsPx.size();
    if (y.offsetsPx.size() != count)
        throw definition.error("as many Y-FlatParameters as X-FlatParameters",
                               std::to_string(y.offsetsPx.size()) + " and " + std::to_string(count));
    const auto side = static_cast<size_t>(std::llround(std::sqrt(static_cast<double>(count))));
    if (side < 2 || side * side != count)
        throw definition.error("the offsets of a square grid", std::to_string(count) + " of them");
    return static_cast<int>(side);
}

}  // namespace

bool isSimcadFile(const FileBytes& file) {
    constexpr size_t kWhereRootsAre = 4096;
    return looksLikeXml(file.bytes) &&
           lowerCase(file.bytes.substr(0, kWhereRootsAre)).find("<geometryfile") != std::string::npos;
}

MeshCalibration readSimcadFile(const FileBytes& file, Decisions& decisions) {
    const XmlElement root = parseXml(file);
    if (lowerCase(root.name()) != "geometryfile") throw root.error("GeometryFile as the root", root.name());
    const auto definition = root.child("GeometryDefinition");
    if (!definition) throw root.error("an element GeometryDefinition", "none");
    const Offsets x = readOffsets(*definition, "X-FlatParameters");
    const Offsets y = readOffsets(*definition, "Y-FlatParameters");
    const int side = sideOf(*definition, x, y);

    MeshCalibration mesh{.sizePx = sizeOf(x.rangePx, y.rangePx), .aspect = x.rangePx / y.rangePx};
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const size_t i = mesh.vertices.size();
            const glm::dvec2 node = glm::dvec2(column, row) / (side - 1.0);
            const glm::dvec2 offset(x.offsetsPx[i] / x.rangePx, y.offsetsPx[i] / y.rangePx);
            mesh.vertices.push_back(vertexIfValid({node + offset, node}));
        }
    mesh.cells = decideCells(glm::ivec2(side), CellCut::alternating,
                             "SGCT draws the grid as one strip of triangles that runs to and fro", decisions);
    return mesh;
}

}  // namespace curvewall
