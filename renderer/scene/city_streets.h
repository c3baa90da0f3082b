#pragma once
// What lies and stands in the streets of a block, in its parks and on its plazas.

#include "renderer/scene/city_plan.h"
#include "renderer/scene/mesh_builder.h"

#include <functional>
#include <vector>

namespace curvewall {

using StreetItem = std::function<void(MeshBuilder&)>;

// The raised ground of the block: 22 triangles.
void addSidewalk(MeshBuilder& mesh, const Block& block);

void addLawn(MeshBuilder& mesh, const Lot& lot);

// All that could stand around a block, what matters most first. The list is longer than the triangles usually
// last.
std::vector<StreetItem> planStreetItems(const Block& block);

}  // namespace curvewall
