#pragma once
// The walls that are measured, each with its pieces.

#include "calibration/pieces/piece_fit.h"
#include "renderer/render.h"

#include <memory>
#include <string>

namespace curvewall {

struct PieceWall {
    std::string name;
    WallPtr wall;
    double tolerancePx = kDefaultTolerancePx;
    std::shared_ptr<const FittedPieces> pieces;
};

PieceWall fittedWall(std::string name, Wall wall, double tolerancePx);

PieceWall fullCylinder(double tolerancePx = 0.25);
PieceWall domeMaster(double tolerancePx = 0.5);
PieceWall planar90();  // as large as the full cylinder
PieceWall quarterCylinder();

// The picture of planar90() through 80 x 60 nodes with the offsets of configs/camera-texture.json.
PieceWall cameraTexture(double tolerancePx = 0.5);

// 90 degrees in as many pixels as the dome master has, looking ahead or straight up.
PieceWall squareAhead();
PieceWall squareUp();

// The full cylinder in so many even columns and rows, whatever its error.
PieceWall evenCylinder(glm::ivec2 cells);

// The display of cameraTexture() in two triangles a cell, whatever their error.
PieceWall evenCameraTexture(glm::ivec2 cells);

RenderRequest requestFor(const PieceWall& wall, const ScenePtr& scene, int frames);

}  // namespace curvewall
