#include "calibration/readers/grid_reader.h"

#include "calibration/errors.h"
#include "calibration/formats/mesh_calibration.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/surface_map.h"
#include "calibration/readers/projection_fields.h"
#include "calibration/readers/warp_mesh_file.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr Range kScale{-1e6, 1e6};

struct Choice {
    const char* word;
    const char* meaning;
};

// The place of the file's word among the choices. What differs from program to program has no default.
size_t requiredMeaning(JsonFields& fields, const char* key, std::initializer_list<Choice> choices) {
    const auto word = fields.text(key);
    size_t place = 0;
    std::string expected;
    for (const Choice& choice : choices) {
        if (word == choice.word) return place;
        if (place++ > 0) expected += " or ";
        expected += std::string(choice.word) + " (" + choice.meaning + ")";
    }
    throw FieldError(word ? FieldError::Kind::value : FieldError::Kind::shape, fields.nameOf(key), expected,
                     word ? "\"" + *word + "\"" : "nothing");
}

Alignment readAlignment(JsonFields& fields) {
    const bool corners = requiredMeaning(fields, "alignment",
                                         {{"centers", "node i of n at (i + 1/2) / n, as texels lie"},
                                          {"corners", "node i of n at i / (n - 1)"}}) == 1;
    return corners ? Alignment::corners : Alignment::centers;
}

std::string sizeOf(glm::ivec2 size) { return std::to_string(size.x) + " x " + std::to_string(size.y); }

NumberMap readNodes(const std::string& path, int channels, int leastNodes) {
    NumberMap map = readNumberMap(path);
    if (map.channels < channels)
        throw InputError(path, "", "at least " + std::to_string(channels) + " channels",
                         std::to_string(map.channels));
    if (std::min(map.sizePx.x, map.sizePx.y) < leastNodes)
        throw InputError(path, "", "at least " + sizeOf(glm::ivec2(leastNodes)) + " nodes",
                         sizeOf(map.sizePx));
    return map;
}

// For a GridMap or a MeasuredSurface.
template <class Map>
void refuseEmpty(const Map& map, const std::string& path) {
    if (!map.hasSamples()) throw InputError(path, "", "a map", "no valid sample anywhere");
    if (!map.hasArea())
        throw InputError(path, "", "a map that covers an area",
                         "one that collapses everywhere: no cell with valid corners has an area");
}

Frustum readBaseImage(JsonFields& fields) {
    const Orientation orientation = readOrientationAtInfinity(fields);
    JsonFields angles = fields.required("base", fields.object("base"));
    Frustum base = readFrustumAngles(angles);
    base.orientation = orientation;
    angles.refuseUnknownKeys();
    return base;
}

NodeMeaning readMeaning(JsonFields& fields, glm::dvec2 sizePx, bool isInteger) {
    NodeMeaning meaning;
    meaning.isOffset = requiredMeaning(fields, "semantics",
                                       {{"offset", "relative to the node"}, {"absolute", "a position"}}) == 0;
    meaning.bottomRowFirst = requiredMeaning(fields, "origin",
                                             {{"top_left", "top row first, y down"},
                                              {"bottom_left", "bottom row first, y up"}}) == 1;
    const bool normalized = requiredMeaning(fields, "units",
                                            {{"px", "pixels of the display"},
                                             {"normalized", "fractions of its width and height"}}) == 1;
    // No program agrees with another on what the integers of a picture stand for.
    const double scale =
        isInteger ? requiredNumber(fields, "scale", kScale) : fields.number("scale", kScale).value_or(1);
    if (scale == 0)
        throw FieldError(FieldError::Kind::value, fields.nameOf("scale"), "a number other than 0", "0");
    const double zero = fields.number("zero", kScale).value_or(isInteger ? 0.5 : 0.0);
    meaning.gain = scale * (normalized ? sizePx : glm::dvec2(1));
    meaning.bias = -zero * meaning.gain;
    if (meaning.bottomRowFirst) {
        meaning.gain.y = -meaning.gain.y;
        meaning.bias.y = (meaning.isOffset ? 0 : sizePx.y) - meaning.bias.y;
    }
    return meaning;
}

double readUnitM(JsonFields& fields) {
    const std::vector<double> kMetres{1, 0.1, 0.01, 0.001, 0.0254, 0.3048, 0.9144};
    return kMetres[requiredMeaning(fields, "units",
                                   {{"m", "metres"},
                                    {"dm", "0.1 m"},
                                    {"cm", "0.01 m"},
                                    {"mm", "0.001 m"},
                                    {"in", "0.0254 m"},
                                    {"ft", "0.3048 m"},
                                    {"yd", "0.9144 m"}})];
}

// Positions of the file to pixels of the display, y down.
struct ScreenUnits {
    glm::dvec2 gain;
    glm::dvec2 bias;
};

ScreenUnits readScreenUnits(JsonFields& fields, glm::dvec2 sizePx) {
    switch (requiredMeaning(fields, "screen_units",
                            {{"px", "from the top left, y down"},
                             {"normalized", "0 to 1 from the top left, y down"},
                             {"aspect", "x from -width/height to width/height, y from -1 to 1 upwards"}})) {
        case 0:
            return {glm::dvec2(1), glm::dvec2(0)};
        case 1:
            return {sizePx, glm::dvec2(0)};
        default:
            return {sizePx.y / 2 * glm::dvec2(1, -1), sizePx / 2.0};
    }
}

std::vector<std::optional<MeshVertex>> meshVertices(const MeshFile& file, const ScreenUnits& units,
                                                    glm::dvec2 sizePx, bool sourceFromBottom) {
    std::vector<std::optional<MeshVertex>> vertices;
    for (const auto& vertex : file.vertices) {
        vertices.emplace_back();
        if (!vertex || vertex->intensity < 0 || !isWithinPicture(vertex->source)) continue;
        vertices.back() = {
            (units.gain * vertex->screen + units.bias) / sizePx,
            sourceFromBottom ? glm::dvec2(vertex->source.x, 1 - vertex->source.y) : vertex->source,
            vertex->intensity};
    }
    return vertices;
}

std::vector<WarpCell> warpCells(JsonFields& fields, const MeshFile& mesh) {
    const bool bilinear = readChoice(fields, "interpolation", {"triangles", "bilinear"}) == "bilinear";
    if (mesh.grid) return bilinear ? quadrilateralsOfGrid(*mesh.grid) : trianglesOfGrid(*mesh.grid);
    if (bilinear)
        throw FieldError(FieldError::Kind::value, fields.nameOf("interpolation"),
                         "triangles for a mesh of triangles", "\"bilinear\"");
    std::vector<WarpCell> cells;
    for (const auto& t : mesh.triangles) cells.push_back({{t[0], t[1], t[2], 0}, CellShape::triangle});
    return cells;
}

}  // namespace

ProjectionPtr readCameraTexture(JsonFields& fields, const ProjectionContext& context) {
    const Frustum base = readBaseImage(fields);
    const bool forward = requiredMeaning(fields, "direction",
                                         {{"forward", "where positions of the base image land"},
                                          {"inverse", "which of them pixels show"}}) == 0;
    const Alignment alignment = readAlignment(fields);
    const std::string path = requiredPath(fields, "offsets", context.folder);
    NumberMap numbers = readNodes(path, 2, alignment == Alignment::corners ? 2 : 1);
    const NodeMeaning meaning = readMeaning(fields, context.sizePx, numbers.isInteger);
    auto map = std::make_shared<const GridMap>(std::move(numbers), meaning, context.sizePx, alignment);
    refuseEmpty(*map, path);
    return std::make_shared<CameraTexture>(std::move(map),
                                           std::make_shared<FrustumProjection>(base, context.sizePx),
                                           forward ? MapDirection::forward : MapDirection::inverse);
}

ProjectionPtr readSurfaceMap(JsonFields& fields, const ProjectionContext& context) {
    const Pose pose = readPose(fields);
    const double unitM = readUnitM(fields);
    const Alignment alignment = readAlignment(fields);
    const bool bottomRowFirst =
        requiredMeaning(fields, "origin",
                        {{"top_left", "top row first"}, {"bottom_left", "bottom row first"}}) == 1;
    const std::string path = requiredPath(fields, "points", context.folder);
    auto surface = std::make_shared<const MeasuredSurface>(readNodes(path, 3, 2), bottomRowFirst,
                                                           context.sizePx, alignment);
    refuseEmpty(*surface, path);
    return std::make_shared<SurfaceMap>(std::move(surface), unitM, pose, context.eyeM);
}

ReadProjection readWarpMesh(JsonFields& fields, const ProjectionContext& context) {
    const ScreenUnits units = readScreenUnits(fields, context.sizePx);
    const bool sourceFromBottom =
        requiredMeaning(fields, "source_origin",
                        {{"top_left", "v grows downwards"}, {"bottom_left", "v grows upwards"}}) == 1;
    const double gamma = fields.number("intensity_gamma", {0, 10, true}).value_or(2.2);
    JsonFields sourceFields = fields.required("source", fields.object("source"));
    const SourcePicture source = readSource(sourceFields, context);
    const std::string path = requiredPath(fields, "mesh", context.folder);
    const MeshFile file = readMeshFile(path);
    const MeshCalibration mesh{meshVertices(file, units, context.sizePx, sourceFromBottom),
                               warpCells(fields, file)};
    MeshDisplay display = meshOnDisplay(mesh, context.sizePx, source, gamma, path);
    return {std::move(display.projection), std::move(display.intensity)};
}

SourcePicture readSource(JsonFields& source, const ProjectionContext& context) {
    const auto size = source.required("size", source.wholeNumbers("size", 2, 1, kMostPx));
    const glm::ivec2 sizePx(static_cast<int>(size[0]), static_cast<int>(size[1]));
    JsonFields projection = source.required("projection", source.object("projection"));
    const std::string type = projection.required("type", projection.text("type"));
    if (type == "warp_mesh")
        throw FieldError(FieldError::Kind::value, projection.nameOf("type"), "any type but another warp_mesh",
                         "\"warp_mesh\"");
    ReadProjection read = readProjection(projection, type, {context.folder, context.eyeM, sizePx});
    projection.refuseUnknownKeys();
    source.refuseUnknownKeys();
    return {sizePx, std::move(read.projection)};
}

}  // namespace curvewall
