#include "renderer/scene/city_furniture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>

namespace curvewall {
namespace {

// Maps (right, up, forward) metres at a spot to the scene.
class Frame {
public:
    explicit Frame(const Spot& spot) : spot_(spot), right_(-spot.front.z, 0, spot.front.x) {}

    glm::vec3 point(float right, float up, float forward) const {
        return spot_.atM + right * right_ + glm::vec3(0, up, 0) + forward * spot_.front;
    }
    Box box(glm::vec3 low, glm::vec3 high) const {
        const glm::vec3 a = point(low.x, low.y, low.z), b = point(high.x, high.y, high.z);
        return {glm::min(a, b), glm::max(a, b)};
    }
    Box post(float width, float bottom, float top) const {
        return box({-0.5f * width, bottom, -0.5f * width}, {0.5f * width, top, 0.5f * width});
    }

private:
    Spot spot_;
    glm::vec3 right_;
};

// Counter-clockwise in (right, forward), which is counter-clockwise seen from above.
constexpr std::array<glm::vec2, 8> kOctagon{{{0.9239f, 0.3827f},
                                             {0.3827f, 0.9239f},
                                             {-0.3827f, 0.9239f},
                                             {-0.9239f, 0.3827f},
                                             {-0.9239f, -0.3827f},
                                             {-0.3827f, -0.9239f},
                                             {0.3827f, -0.9239f},
                                             {0.9239f, -0.3827f}}};

// An upright disc that looks to the front (towards +forward): 6 triangles.
void addDisc(MeshBuilder& mesh, Paint paint, const Frame& frame, glm::vec3 middle, float radius) {
    const auto corner = [&](size_t i) {  // seen from the front, right is to the left
        return frame.point(middle.x - radius * kOctagon[i].x, middle.y + radius * kOctagon[i].y, middle.z);
    };
    for (size_t i = 1; i + 1 < kOctagon.size(); ++i)
        mesh.paintedTriangle(paint, corner(0), corner(i), corner(i + 1));
}

void addWheel(MeshBuilder& mesh, const Frame& frame, float right, float forward) {
    constexpr float kRadiusM = 0.33f;
    const auto corner = [&](size_t i) {
        const float turn = right > 0 ? 1.0f : -1.0f;
        return frame.point(right, kRadiusM + kRadiusM * kOctagon[i].y,
                           forward + turn * kRadiusM * kOctagon[i].x);
    };
    for (size_t i = 1; i + 1 < kOctagon.size(); ++i)
        mesh.paintedTriangle(Paint::black, corner(0), corner(i), corner(i + 1));
}

// A round body with uneven surface: an icosahedron.
void addCrown(MeshBuilder& mesh, glm::vec3 middle, glm::vec3 radii, Random& random) {
    constexpr float kA = 0.525731f, kB = 0.850651f;
    constexpr std::array<glm::vec3, 12> kDirections{{{-kA, kB, 0},
                                                     {kA, kB, 0},
                                                     {-kA, -kB, 0},
                                                     {kA, -kB, 0},
                                                     {0, -kA, kB},
                                                     {0, kA, kB},
                                                     {0, -kA, -kB},
                                                     {0, kA, -kB},
                                                     {kB, 0, -kA},
                                                     {kB, 0, kA},
                                                     {-kB, 0, -kA},
                                                     {-kB, 0, kA}}};
    constexpr std::array<glm::uvec3, 20> kFaces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    std::array<Corner, 12> corners;
    std::array<glm::vec3, 12> normals;
    for (size_t i = 0; i < kDirections.size(); ++i) {
        const glm::vec3 offset = random.between(0.85f, 1.1f) * radii * kDirections[i];
        corners[i] = {middle + offset,
                      {0.22f * (middle.x + offset.x + offset.z), 0.22f * (middle.z - offset.y)}};
        normals[i] = kDirections[i] / radii;
    }
    mesh.smoothBody(CityMaterial::foliage, corners, normals, kFaces);
}

}  // namespace

void addCar(MeshBuilder& mesh, const Spot& spot, Random random) {
    constexpr std::array kCarPaints{Paint::white, Paint::silver, Paint::grey,     Paint::black,
                                    Paint::red,   Paint::blue,   Paint::darkBlue, Paint::darkRed,
                                    Paint::cream, Paint::teal,   Paint::yellow,   Paint::darkGreen};
    const Paint paint = kCarPaints[random.below(kCarPaints.size())];
    const Frame frame(spot);
    const bool van = random.chance(0.15f);
    const float length = van ? 2.5f : random.between(1.95f, 2.25f),
                roofM = van ? 2.05f : random.between(1.4f, 1.52f);
    mesh.paintedBox(paint, frame.box({-0.86f, 0.26f, -length}, {0.86f, 0.84f, length}),
                    BoxFaces::sidesAndTop);
    const float cabinBack = van ? 2.4f : 1.75f, cabinFront = van ? 1.5f : 1.0f;
    mesh.paintedFrustum(van ? paint : Paint::darkGlass,
                        frame.box({-0.8f, 0.84f, -cabinBack}, {0.8f, roofM - 0.06f, cabinFront}),
                        van ? 0.92f : 0.76f, BoxFaces::sides);
    const float scale = van ? 0.92f : 0.76f, middle = 0.5f * (cabinFront - cabinBack),
                half = 0.5f * scale * (cabinFront + cabinBack);
    mesh.paintedBox(
        paint, frame.box({-0.8f * scale, roofM - 0.06f, middle - half}, {0.8f * scale, roofM, middle + half}),
        BoxFaces::sidesAndTop);
    for (const float forward : {-0.64f * length, 0.64f * length})
        for (const float right : {-0.875f, 0.875f}) addWheel(mesh, frame, right, forward);
    for (const float right : {-0.58f, 0.58f}) {
        const auto light = [&](Paint color, float forward, float turn) {
            mesh.paintedQuad(color, frame.point(right + turn * 0.17f, 0.56f, forward),
                             frame.point(right - turn * 0.17f, 0.56f, forward),
                             frame.point(right - turn * 0.17f, 0.74f, forward),
                             frame.point(right + turn * 0.17f, 0.74f, forward));
        };
        light(Paint::lamp, length + 0.01f, 1);
        light(Paint::red, -length - 0.01f, -1);
    }
}

void addStreetLamp(MeshBuilder& mesh, const Spot& spot) {
    const Frame frame(spot);
    mesh.paintedFrustum(Paint::darkGrey, frame.post(0.2f, 0, 6.2f), 0.5f, BoxFaces::sides);
    mesh.paintedBox(Paint::darkGrey, frame.box({-0.04f, 6.1f, -0.05f}, {0.04f, 6.2f, 1.3f}), BoxFaces::all);
    mesh.paintedBox(Paint::lamp, frame.box({-0.14f, 5.98f, 0.75f}, {0.14f, 6.1f, 1.35f}), BoxFaces::all);
}

void addTrafficLight(MeshBuilder& mesh, const Spot& spot, Random random) {
    const Frame frame(spot);
    mesh.paintedBox(Paint::darkGrey, frame.post(0.12f, 0, 2.5f), BoxFaces::sides);
    mesh.paintedBox(Paint::black, frame.box({-0.17f, 2.5f, -0.14f}, {0.17f, 3.5f, 0.14f}), BoxFaces::all);
    constexpr std::array kLights{Paint::green, Paint::orange, Paint::red};
    const uint32_t lit = random.chance(0.5f) ? 0 : 2;
    for (uint32_t i = 0; i < 3; ++i) {
        const float up = 2.56f + 0.31f * static_cast<float>(i);
        const Paint paint = i == lit ? kLights[i] : Paint::darkGrey;
        mesh.paintedQuad(paint, frame.point(0.11f, up, 0.15f), frame.point(-0.11f, up, 0.15f),
                         frame.point(-0.11f, up + 0.24f, 0.15f), frame.point(0.11f, up + 0.24f, 0.15f));
    }
}

void addTrafficSign(MeshBuilder& mesh, const Spot& spot, Random random) {
    const Frame frame(spot);
    mesh.paintedBox(Paint::silver, frame.post(0.07f, 0, 2.9f), BoxFaces::sides);
    if (random.chance(0.4f)) {
        mesh.paintedBox(Paint::blue, frame.box({-0.32f, 2.2f, 0.04f}, {0.32f, 2.84f, 0.08f}), BoxFaces::all);
        return;
    }
    addDisc(mesh, Paint::red, frame, {0, 2.5f, 0.05f}, 0.36f);
    addDisc(mesh, Paint::white, frame, {0, 2.5f, 0.07f}, random.chance(0.5f) ? 0.26f : 0.12f);
}

void addBench(MeshBuilder& mesh, const Spot& spot) {
    const Frame frame(spot);
    for (const float right : {-0.7f, 0.62f})
        mesh.paintedBox(Paint::darkGrey, frame.box({right, 0, -0.2f}, {right + 0.08f, 0.42f, 0.22f}),
                        BoxFaces::sides);
    mesh.paintedBox(Paint::brown, frame.box({-0.85f, 0.42f, -0.25f}, {0.85f, 0.48f, 0.25f}), BoxFaces::all);
    mesh.paintedBox(Paint::brown, frame.box({-0.85f, 0.58f, -0.3f}, {0.85f, 0.88f, -0.25f}), BoxFaces::all);
}

void addLitterBin(MeshBuilder& mesh, const Spot& spot) {
    mesh.paintedFrustum(Paint::darkGreen, Frame(spot).post(0.5f, 0.05f, 0.95f), 1.15f, BoxFaces::sidesAndTop);
}

void addBollard(MeshBuilder& mesh, const Spot& spot) {
    mesh.paintedFrustum(Paint::darkGrey, Frame(spot).post(0.2f, 0, 0.9f), 0.75f, BoxFaces::sidesAndTop);
}

void addHydrant(MeshBuilder& mesh, const Spot& spot) {
    const Frame frame(spot);
    mesh.paintedBox(Paint::red, frame.post(0.26f, 0, 0.6f), BoxFaces::sides);
    mesh.paintedFrustum(Paint::red, frame.post(0.34f, 0.6f, 0.78f), 0.5f, BoxFaces::all);
}

void addBroadleaf(MeshBuilder& mesh, const Spot& spot, Random random) {
    const Frame frame(spot);
    const float trunkM = random.between(2.0f, 2.8f), radiusM = random.between(1.3f, 1.9f);
    mesh.paintedFrustum(Paint::darkWood, frame.post(0.34f, 0, trunkM + 0.6f), 0.6f, BoxFaces::sides);
    const glm::vec3 middle = frame.point(0, trunkM + 0.9f * radiusM, 0);
    addCrown(mesh, middle, {radiusM, random.between(0.9f, 1.25f) * radiusM, radiusM}, random);
    if (random.chance(0.6f)) {
        const glm::vec3 shift(random.between(-0.4f, 0.4f), random.between(0.55f, 0.8f),
                              random.between(-0.4f, 0.4f));
        addCrown(mesh, middle + radiusM * shift, glm::vec3(0.72f * radiusM), random);
    }
}

void addConifer(MeshBuilder& mesh, const Spot& spot, Random random) {
    const Frame frame(spot);
    mesh.paintedBox(Paint::darkWood, frame.post(0.3f, 0, 1.1f), BoxFaces::sides);
    const float heightM = random.between(5.0f, 9.0f);
    for (int tier = 0; tier < 3; ++tier) {
        const float bottom = 0.9f + 0.26f * static_cast<float>(tier) * heightM;
        const float radius = (0.24f - 0.055f * static_cast<float>(tier)) * heightM;
        const glm::vec3 tip = frame.point(0, bottom + 0.48f * heightM, 0);
        for (size_t i = 0; i < kOctagon.size(); ++i) {
            const glm::vec2 a = radius * kOctagon[i], b = radius * kOctagon[(i + 1) % kOctagon.size()];
            const glm::vec3 left = frame.point(a.x, bottom, a.y), right = frame.point(b.x, bottom, b.y);
            mesh.triangle(CityMaterial::foliage, {left, {0.3f * a.x, 0.3f * a.y}},
                          {right, {0.3f * b.x, 0.3f * b.y}}, {tip, {0.1f * heightM, 0}});
        }
    }
}

void addFountain(MeshBuilder& mesh, const Spot& spot) {
    const Frame frame(spot);
    constexpr float kOuterM = 3.2f, kInnerM = 2.8f, kRimM = 0.6f, kWaterM = 0.42f;
    for (size_t i = 0; i < kOctagon.size(); ++i) {
        const glm::vec2 a = kOctagon[i], b = kOctagon[(i + 1) % kOctagon.size()];
        const auto at = [&](glm::vec2 p, float radius, float up) {
            return frame.point(radius * p.x, up, radius * p.y);
        };
        mesh.paintedQuad(Paint::sand, at(a, kOuterM, 0), at(b, kOuterM, 0), at(b, kOuterM, kRimM),
                         at(a, kOuterM, kRimM));
        mesh.paintedQuad(Paint::sand, at(a, kOuterM, kRimM), at(b, kOuterM, kRimM), at(b, kInnerM, kRimM),
                         at(a, kInnerM, kRimM));
        mesh.paintedQuad(Paint::sand, at(b, kInnerM, kWaterM), at(a, kInnerM, kWaterM), at(a, kInnerM, kRimM),
                         at(b, kInnerM, kRimM));
        mesh.paintedTriangle(Paint::teal, at(a, kInnerM, kWaterM), at(b, kInnerM, kWaterM),
                             frame.point(0, kWaterM, 0));
    }
    mesh.paintedFrustum(Paint::sand, frame.post(0.7f, kWaterM - 0.1f, 1.6f), 0.6f, BoxFaces::sidesAndTop);
}

void addLeaf(MeshBuilder& mesh, glm::vec3 atM, Random& random) {
    constexpr std::array kLeafPaints{Paint::autumn, Paint::rust, Paint::green, Paint::brown, Paint::sand};
    const Paint paint = kLeafPaints[random.below(kLeafPaints.size())];
    const float length = random.between(0.08f, 0.18f), width = random.between(0.05f, 0.1f);
    const float lift = random.between(0.02f, 0.05f);
    mesh.paintedTriangle(paint, atM + glm::vec3(0, lift, 0), atM + glm::vec3(length, lift + 0.02f, width),
                         atM + glm::vec3(length, lift, -width));
}

}  // namespace curvewall
