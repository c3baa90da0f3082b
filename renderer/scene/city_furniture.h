#pragma once
// What stands in the streets.

#include "renderer/scene/mesh_builder.h"
#include "renderer/scene/random.h"

#include <glm/vec3.hpp>

namespace curvewall {

// A place on the ground and where its front looks: a unit vector along x or z.
struct Spot {
    glm::vec3 atM;
    glm::vec3 front;
};

void addCar(MeshBuilder& mesh, const Spot& spot, Random random);
void addStreetLamp(MeshBuilder& mesh, const Spot& spot);  // its arm reaches over the street
void addTrafficLight(MeshBuilder& mesh, const Spot& spot, Random random);
void addTrafficSign(MeshBuilder& mesh, const Spot& spot, Random random);
void addBench(MeshBuilder& mesh, const Spot& spot);
void addLitterBin(MeshBuilder& mesh, const Spot& spot);
void addBollard(MeshBuilder& mesh, const Spot& spot);
void addHydrant(MeshBuilder& mesh, const Spot& spot);
void addBroadleaf(MeshBuilder& mesh, const Spot& spot, Random random);
void addConifer(MeshBuilder& mesh, const Spot& spot, Random random);
void addFountain(MeshBuilder& mesh, const Spot& spot);
void addLeaf(MeshBuilder& mesh, glm::vec3 atM, Random& random);  // a single triangle on the ground

}  // namespace curvewall
