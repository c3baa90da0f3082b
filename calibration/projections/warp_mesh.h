#pragma once
// A mesh that bends a finished picture onto the screen, as projection programs write them: positions on the
// screen with positions in a source picture, whose own projection tells what is seen there.

#include "calibration/projections/bilinear_cell.h"
#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace curvewall {

struct WarpVertex {
    glm::dvec2 screenPx{0};
    glm::dvec2 sourcePx{0};
    double intensity = 1;
    bool isValid = true;  // cells that use others are holes
};

// Vertices at (s, t) = (0, 0), (1, 0), (0, 1) and, in a quadrilateral, (1, 1).
struct WarpCell {
    std::array<uint32_t, 4> vertices{};
    CellShape shape = CellShape::triangle;
};

// The cells of a grid of vertices, row by row.
std::vector<WarpCell> quadrilateralsOfGrid(glm::ivec2 vertices);
// Each cell in two: cut from its first vertex to its last, or across between the two others, or one and the
// other by turns: across in the first row, as a triangle strip that runs to and fro does.
enum class CellCut { firstToLast, across, alternating };
std::vector<WarpCell> trianglesOfGrid(glm::ivec2 vertices, CellCut cut = CellCut::firstToLast);

class WarpMesh {
public:
    // `extentPx` is the larger side of the screen or the source: what positions are rounded to.
    WarpMesh(std::vector<WarpVertex> vertices, const std::vector<WarpCell>& cells, double extentPx);
    ~WarpMesh();
    WarpMesh(const WarpMesh&) = delete;
    WarpMesh& operator=(const WarpMesh&) = delete;

    bool hasArea() const { return !cells_.empty(); }  // at least one cell is no hole

    struct Sample {
        glm::dvec2 sourcePx;
        double intensity;
    };
    // Where cells overlap: the first one in the file among those that face as most do, if there are any.
    std::optional<Sample> at(glm::dvec2 screenPx) const;

    // Every position on the screen that shows one of the source.
    std::vector<glm::dvec2> positions(glm::dvec2 sourcePx) const;

private:
    struct Boxes;
    maths::BilinearCell cellOf(const WarpCell& cell, glm::dvec2 WarpVertex::*place) const;
    double facingAt(const WarpCell& cell, glm::dvec2 st) const;
    double intensityAt(const WarpCell& cell, glm::dvec2 st) const;
    bool isHole(const WarpCell& cell) const;
    std::unique_ptr<const Boxes> boxesOf(glm::dvec2 WarpVertex::*place) const;

    std::vector<WarpVertex> vertices_;
    std::vector<WarpCell> cells_;  // without holes
    double slackPx_;
    double facing_ = 1;
    std::unique_ptr<const Boxes> onScreen_, inSource_;
};

class WarpMeshProjection : public Projection {
public:
    WarpMeshProjection(std::shared_ptr<const WarpMesh> mesh, ProjectionPtr source);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return source_->dependsOnEye(); }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

private:
    std::shared_ptr<const WarpMesh> mesh_;
    ProjectionPtr source_;
};

// What the mesh multiplies the picture by at every pixel centre, in linear light: intensity ^ gamma. One in
// holes; empty where it is one everywhere.
std::vector<float> linearIntensity(const WarpMesh& mesh, glm::ivec2 sizePx, double gamma);

}  // namespace curvewall
