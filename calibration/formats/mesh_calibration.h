#pragma once
// What the files of warp meshes have in common, once their conventions are settled: vertices on the screen
// with positions in a source picture.

#include "calibration/files/file_bytes.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/formats/decisions.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/warp_mesh.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace curvewall {

// Fractions of the display and of the source picture: (0, 0) is the top left corner, y grows downwards.
struct MeshVertex {
    glm::dvec2 screen{0};
    glm::dvec2 source{0};
    double intensity = 1;  // multiplies encoded colours
};

struct MeshCalibration {
    std::vector<std::optional<MeshVertex>> vertices{};  // cells with one that is missing are holes
    std::vector<WarpCell> cells{};
    std::optional<Frustum> frustum{};        // what the source shows, where the file tells it
    bool bendsFisheye = false;               // meshes of the format are made for a fisheye as the source
    std::optional<glm::ivec2> sizePx{};      // of the display, where the file tells it
    std::optional<double> aspect{};          // its width over its height, likewise
    std::optional<double> intensityGamma{};  // likewise
};

struct MeshDisplay {
    ProjectionPtr projection;
    std::vector<float> intensity;  // factors of the picture, a pixel each; empty: one everywhere
};

// The mesh on a display, seen through to what `source` shows. Intensities become linear by ^ gamma. `path` is
// for messages. Throws InputError for a mesh without area.
MeshDisplay meshOnDisplay(const MeshCalibration& mesh, glm::ivec2 sizePx, const SourcePicture& source,
                          double intensityGamma, const std::string& path);

// What becomes of numbers from a file: nothing for a vertex with one that is not finite or with a negative
// intensity.
std::optional<MeshVertex> vertexIfValid(const MeshVertex& vertex);

// Throws InputError unless the frustum's picture has an area.
void requireFrustum(const Frustum& frustum, const FileBytes& file);

// Decides how the cells of a measured grid are filled.
std::vector<WarpCell> decideCells(glm::ivec2 vertices, CellCut guess, const std::string& evidence,
                                  Decisions& decisions);

// Decides the gamma of the intensities; asks nothing where all of them are one.
double decideIntensityGamma(const MeshCalibration& mesh, Decisions& decisions);

bool isWithinPicture(glm::dvec2 fraction);  // 0 to 1 in both directions

// Decides what a picture shows that no file and no user tells about: a fisheye or a perspective view.
SourcePicture decideSource(bool isFisheye, const std::string& evidence, glm::ivec2 displayPx,
                           Decisions& decisions);

// The whole display, with the source that the file's frustum, the user or else an assumption gives.
Display meshDisplay(const MeshCalibration& mesh, const FileBytes& file, const CalibrationRequest& request,
                    Decisions& decisions);

}  // namespace curvewall
