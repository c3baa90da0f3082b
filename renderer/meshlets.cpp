#include "renderer/meshlets.h"

#include "calibration/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <meshoptimizer.h>
#include <numeric>
#include <utility>

namespace curvewall {
namespace shared {

using glm::cross, glm::dot, glm::length, glm::vec3;
#define SHARED_FN inline
#include "shaders/meshlet_cone.glsl"
#undef SHARED_FN

}  // namespace shared

namespace {

// meshoptimizer's own limit, which 64 triangles without common vertices do not reach.
constexpr size_t kMostVertices = 255;

// Vertices with one position have one index.
struct WeldedTriangles {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> corners;  // three a triangle
};

WeldedTriangles weld(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
    std::vector<glm::vec3> soup;
    soup.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles)
        for (int i = 0; i < 3; ++i) soup.push_back(positions[triangle[i]] + 0.0f);  // -0 becomes 0
    WeldedTriangles welded;
    welded.corners.resize(soup.size());
    welded.positions.resize(meshopt_generateVertexRemap(welded.corners.data(), nullptr, soup.size(),
                                                        soup.data(), soup.size(), sizeof(glm::vec3)));
    meshopt_remapVertexBuffer(welded.positions.data(), soup.data(), soup.size(), sizeof(glm::vec3),
                              welded.corners.data());
    return welded;
}

// meshoptimizer gives triangles by their corners; this tells which they were.
class TriangleLookup {
public:
    explicit TriangleLookup(std::span<const uint32_t> corners)
        : corners_(corners), sorted_(corners.size() / 3), taken_(corners.size() / 3) {
        std::iota(sorted_.begin(), sorted_.end(), 0u);
        std::ranges::sort(sorted_, [&](uint32_t a, uint32_t b) {
            return std::pair(cornersOf(a), a) < std::pair(cornersOf(b), b);
        });
    }

    // Each triangle with these corners once.
    uint32_t take(const std::array<uint32_t, 3>& corners) {
        const auto first =
            std::ranges::lower_bound(sorted_, corners, {}, [&](uint32_t t) { return cornersOf(t); });
        // The first of a run of equals counts how many of them are gone.
        return *(first + taken_[static_cast<size_t>(first - sorted_.begin())]++);
    }

private:
    std::array<uint32_t, 3> cornersOf(uint32_t triangle) const {
        const size_t first = size_t{3} * triangle;
        return {corners_[first], corners_[first + 1], corners_[first + 2]};
    }

    std::span<const uint32_t> corners_;
    std::vector<uint32_t> sorted_;
    std::vector<uint32_t> taken_;
};

// Of about length one, and otherwise the same bits: meshoptimizer squares lengths in single precision, and
// leaves out triangles where a square is infinite.
std::vector<glm::vec3> atUnitScale(std::vector<glm::vec3> positions) {
    float largest = 0;
    for (const glm::vec3& p : positions)
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (largest == 0) return positions;
    const int exponent = std::ilogb(largest);
    for (glm::vec3& p : positions)
        p = {std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent)};
    return positions;
}

// The triangles of each cluster in scene order, clusters in the order of their first triangles.
std::vector<std::vector<uint32_t>> clustersOf(const WeldedTriangles& welded, size_t mostTriangles) {
    const size_t count = welded.corners.size(), mostVertices = std::min(3 * mostTriangles, kMostVertices);
    const size_t bound = meshopt_buildMeshletsBound(count, mostVertices, mostTriangles);
    const std::vector<glm::vec3> positions = atUnitScale(welded.positions);
    std::vector<meshopt_Meshlet> built(bound);
    std::vector<uint32_t> vertices(bound * mostVertices);
    std::vector<uint8_t> corners(3 * bound * mostTriangles);
    // A weight for cones makes spheres larger, and was not seen to make cones that leave more out.
    built.resize(meshopt_buildMeshlets(built.data(), vertices.data(), corners.data(), welded.corners.data(),
                                       count, &positions[0].x, positions.size(), sizeof(glm::vec3),
                                       mostVertices, mostTriangles, 0));
    TriangleLookup lookup(welded.corners);
    std::vector<std::vector<uint32_t>> clusters;
    for (const meshopt_Meshlet& meshlet : built) {
        std::vector<uint32_t>& cluster = clusters.emplace_back();
        for (uint32_t i = 0; i < meshlet.triangle_count; ++i) {
            const uint8_t* local = &corners[meshlet.triangle_offset + 3 * i];
            cluster.push_back(lookup.take({vertices[meshlet.vertex_offset + local[0]],
                                           vertices[meshlet.vertex_offset + local[1]],
                                           vertices[meshlet.vertex_offset + local[2]]}));
        }
        std::ranges::sort(cluster);
    }
    std::ranges::sort(clusters, {}, [](const std::vector<uint32_t>& cluster) { return cluster.front(); });
    return clusters;
}

glm::dvec3 farthestFrom(glm::dvec3 place, std::span<const glm::dvec3> points) {
    glm::dvec3 farthest = points.front();
    double most = -1;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 off = point - place;
        const double squared = glm::dot(off, off);
        if (squared <= most) continue;
        most = squared;
        farthest = point;
    }
    return farthest;
}

// The centre of nearly the smallest ball: from the middle of the box, smaller and smaller steps to what is
// farthest (Badoiu and Clarkson, 2003).
glm::dvec3 ballCentre(std::span<const glm::dvec3> points) {
    constexpr int kSteps = 16;
    glm::dvec3 least = points.front(), most = points.front();
    for (const glm::dvec3& point : points) {
        least = glm::min(least, point);
        most = glm::max(most, point);
    }
    glm::dvec3 centre = 0.5 * (least + most), best = centre;
    double bestRadius = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
        const glm::dvec3 farthest = farthestFrom(centre, points);
        const double radius = glm::distance(centre, farthest);
        if (radius < bestRadius) {
            best = centre;
            bestRadius = radius;
        }
        centre += (farthest - centre) / (i + 2.0);
    }
    return best;
}

float roundedUp(double value) {
    return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::max());
}

// The geometry of one meshlet in double.
struct Faces {
    std::vector<glm::dvec3> points;   // three a face
    std::vector<glm::dvec3> normals;  // of length one
};

Faces facesOf(const WeldedTriangles& welded, std::span<const uint32_t> triangles) {
    Faces faces;
    for (const uint32_t triangle : triangles) {
        std::array<glm::dvec3, 3> p;
        for (size_t i = 0; i < 3; ++i) p[i] = welded.positions[welded.corners[size_t{3} * triangle + i]];
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        faces.points.insert(faces.points.end(), p.begin(), p.end());
        // One without area is seen from nowhere.
        faces.normals.push_back(normal == glm::dvec3(0) ? normal : glm::normalize(normal));
    }
    return faces;
}

void setCone(Meshlet& meshlet, const Faces& faces) {
    const glm::dvec3 middle = ballCentre(faces.normals);
    const glm::vec3 axis = glm::length(middle) > 0 ? glm::vec3(glm::normalize(middle)) : meshlet.coneAxis;
    double cosine = 1, sine = 0, reach = 0;
    for (size_t i = 0; i < faces.normals.size(); ++i) {
        const glm::dvec3 normal = faces.normals[i];
        if (normal == glm::dvec3(0)) continue;
        cosine = std::min(cosine, glm::dot(normal, glm::dvec3(axis)));
        sine = std::max(sine, glm::length(glm::cross(normal, glm::dvec3(axis))));
        for (size_t k = 3 * i; k < 3 * i + 3; ++k)
            reach = std::max(reach, glm::dot(glm::dvec3(meshlet.centreM) - faces.points[k], normal));
    }
    meshlet.coneAxis = axis;
    meshlet.coneSine = static_cast<float>(sine);
    meshlet.coneCosine = static_cast<float>(cosine);
    meshlet.coneReachM = cosine > 0 ? roundedUp(reach) : std::numeric_limits<float>::max();
}

Meshlet boundsOf(const WeldedTriangles& welded, std::span<const uint32_t> triangles) {
    const Faces faces = facesOf(welded, triangles);
    Meshlet meshlet;
    meshlet.centreM = glm::vec3(ballCentre(faces.points));
    const glm::dvec3 centre(meshlet.centreM);
    meshlet.radiusM = roundedUp(glm::distance(centre, farthestFrom(centre, faces.points)));
    setCone(meshlet, faces);
    return meshlet;
}

Meshlets meshletsOf(const WeldedTriangles& welded, const std::vector<std::vector<uint32_t>>& clusters) {
    Meshlets cut;
    cut.order.reserve(welded.corners.size() / 3);
    for (const std::vector<uint32_t>& cluster : clusters) {
        Meshlet& meshlet = cut.meshlets.emplace_back(boundsOf(welded, cluster));
        meshlet.firstTriangle = static_cast<uint32_t>(cut.order.size());
        meshlet.triangleCount = static_cast<uint32_t>(cluster.size());
        cut.order.insert(cut.order.end(), cluster.begin(), cluster.end());
    }
    return cut;
}

}  // namespace

Meshlets cutIntoMeshlets(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                         uint32_t mostTriangles) {
    if (triangles.empty()) return {};
    const WeldedTriangles welded = weld(positions, triangles);
    return meshletsOf(welded, clustersOf(welded, mostTriangles));
}

Meshlets cutInOrder(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                    uint32_t mostTriangles) {
    std::vector<std::vector<uint32_t>> runs;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        if (i % mostTriangles == 0) runs.emplace_back();
        runs.back().push_back(i);
    }
    return meshletsOf(weld(positions, triangles), runs);
}

bool isBehind(const Meshlet& meshlet, glm::vec3 eyeM) {
    return shared::isMeshletBehind(meshlet.centreM - eyeM, meshlet.coneAxis, meshlet.coneSine,
                                   meshlet.coneCosine, meshlet.coneReachM);
}

}  // namespace curvewall
