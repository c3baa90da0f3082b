#pragma once
// Projections that were measured on a grid, as wall files write them.

#include "calibration/formats/calibration_file.h"
#include "calibration/readers/projection_reader.h"

namespace curvewall {

// Each reads the keys of its type. Throws like readProjection.
ProjectionPtr readCameraTexture(JsonFields& fields, const ProjectionContext& context);
ProjectionPtr readSurfaceMap(JsonFields& fields, const ProjectionContext& context);
ReadProjection readWarpMesh(JsonFields& fields, const ProjectionContext& context);

// A picture that a mesh bends: its `size` in pixels and its `projection`, of any type but another mesh.
SourcePicture readSource(JsonFields& source, const ProjectionContext& context);

}  // namespace curvewall
