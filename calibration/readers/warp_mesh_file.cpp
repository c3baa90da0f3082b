#include "calibration/readers/warp_mesh_file.h"

#include "calibration/files/json_file.h"

#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

constexpr int64_t kMostVertices = 16384;  // on each side of a grid

std::string entryOf(const char* list, size_t index) {
    return std::string(list) + "[" + std::to_string(index) + "]";
}

std::optional<MeshVertex> vertexOf(const json& entry, const std::string& field) {
    if (entry.is_null()) return std::nullopt;
    if (!entry.is_array() || entry.size() < 4 || entry.size() > 5)
        throw FieldError(FieldError::Kind::shape, field, "null or [x, y, u, v] or [x, y, u, v, intensity]",
                         entry.is_array() ? "a list of " + std::to_string(entry.size()) : describe(entry));
    for (const json& number : entry)
        if (!number.is_number())
            throw FieldError(FieldError::Kind::shape, field, "numbers", describe(number));
    constexpr double kMostIntensity = 1000;  // below 0 marks a vertex that is not valid
    if (entry.size() == 5 && entry[4].get<double>() > kMostIntensity)
        throw FieldError(FieldError::Kind::value, field, "an intensity of 1000 at most", describe(entry[4]));
    return MeshVertex{{entry[0].get<double>(), entry[1].get<double>()},
                      {entry[2].get<double>(), entry[3].get<double>()},
                      entry.size() == 5 ? entry[4].get<double>() : 1};
}

std::array<uint32_t, 3> triangleOf(const json& entry, const std::string& field, size_t vertices) {
    if (!entry.is_array() || entry.size() != 3)
        throw FieldError(FieldError::Kind::shape, field, "a list of 3 vertex numbers",
                         entry.is_array() ? "a list of " + std::to_string(entry.size()) : describe(entry));
    std::array<uint32_t, 3> triangle{};
    for (size_t i = 0; i < 3; ++i) {
        if (!entry[i].is_number_unsigned() || entry[i].get<uint64_t>() >= vertices)
            throw FieldError(FieldError::Kind::value, field,
                             "vertex numbers from 0 to " + std::to_string(vertices - 1), describe(entry[i]));
        triangle[i] = entry[i].get<uint32_t>();
    }
    return triangle;
}

MeshFile meshOf(JsonFields fields) {
    MeshFile mesh;
    for (const json& entry : fields.list("vertices"))
        mesh.vertices.push_back(vertexOf(entry, entryOf("vertices", mesh.vertices.size())));
    if (fields.has("grid") && fields.has("triangles"))
        throw FieldError(FieldError::Kind::shape, "", "a grid or triangles", "both");
    if (const auto grid = fields.wholeNumbers("grid", 2, 2, kMostVertices)) {
        mesh.grid = {static_cast<int>((*grid)[0]), static_cast<int>((*grid)[1])};
        if (static_cast<size_t>((*grid)[0] * (*grid)[1]) != mesh.vertices.size())
            throw FieldError(FieldError::Kind::value, "vertices",
                             std::to_string((*grid)[0] * (*grid)[1]) + " for a grid of " +
                                 std::to_string((*grid)[0]) + " x " + std::to_string((*grid)[1]),
                             std::to_string(mesh.vertices.size()));
    } else {
        if (!fields.has("triangles"))
            throw FieldError(FieldError::Kind::shape, "", "a grid or triangles", "neither");
        for (const json& entry : fields.list("triangles"))
            mesh.triangles.push_back(
                triangleOf(entry, entryOf("triangles", mesh.triangles.size()), mesh.vertices.size()));
    }
    fields.refuseUnknownKeys();
    return mesh;
}

}  // namespace

MeshFile readMeshFile(const std::string& path) {
    return readJsonFile(path, "a warp mesh in JSON",
                        [](JsonFields fields) { return meshOf(std::move(fields)); });
}

}  // namespace curvewall
