#include "renderer/screen_map.h"

#include "calibration/errors.h"
#include "calibration/projections/camera_lens.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/cylinder.h"
#include "calibration/projections/equirectangular_lens.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/picture_views.h"
#include "calibration/projections/planar.h"
#include "calibration/projections/projection_maths.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/projections/sphere_slices_lens.h"
#include "renderer/gl/gl_objects.h"
#include "renderer/position_table.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;

std::array<glm::vec4, 3> rowsOf(const glm::dmat3& matrix) {
    const glm::dmat3 rows = glm::transpose(matrix);
    return {glm::vec4(rows[0], 0), glm::vec4(rows[1], 0), glm::vec4(rows[2], 0)};
}

template <size_t count>
void copyTerms(const std::array<double, count>& from, std::array<glm::vec4, 3>& to) {
    static_assert(count <= 12);
    for (size_t i = 0; i < count; ++i)
        to[i / 4][static_cast<glm::length_t>(i % 4)] = static_cast<float>(from[i]);
}

// How many pixels one turn takes.
double turnPx(const AngleAxis& axis) { return 2 * kPi / axis.arcRad * axis.lengthPx; }

glm::dvec2 pxPerRad(const AngleAxis& columns, const AngleAxis& rows) {
    return {columns.lengthPx / columns.arcRad, -rows.lengthPx / rows.arcRad};
}

void useProjective(const glm::dmat3& pixelFromRay, ScreenMap& map) {
    map.defines = {"PROJECTIVE"};
    map.numbers.displayFromWall = rowsOf(pixelFromRay);
}

void useRadial(const RadialLens& lens, ScreenMap& map) {
    const RadialFunction& function = lens.function();
    ScreenMapNumbers& numbers = map.numbers;
    numbers.pixels = glm::vec4(lens.centrePx(), lens.focalPx().x, -lens.focalPx().y);
    if (function.model == RadialModel::stereographic) {
        map.defines = {"STEREOGRAPHIC"};
        return;
    }
    map.defines = {"RADIAL", "RADIAL_MODEL " + std::to_string(static_cast<int>(function.model))};
    numbers.limit = {lens.limitRad(), function.radius(lens.limitRad()), 1, 0};
    copyTerms(function.coefficients, numbers.terms);
}

// How far off its axis the lens sees something of its picture.
double widestRad(const PinholeLens& lens, glm::dvec2 sizePx) {
    constexpr int kSteps = 64;
    double widest = 0;
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x)
            if (const auto d = lens.direction(sizePx * glm::dvec2(x, y) / static_cast<double>(kSteps)))
                widest = std::max(widest, std::atan2(std::hypot(d->x, d->y), -d->z));
    return widest;
}

void usePinhole(const PinholeLens& lens, glm::dvec2 sizePx, ScreenMap& map) {
    map.defines = {"PINHOLE"};
    constexpr double kMarginRad = 0.05;
    const double limitRad =
        std::min(widestRad(lens, sizePx) + kMarginRad, std::atan(lens.mostRadius()) * (1 - 1e-9));
    const double radius = std::tan(limitRad);
    const CameraIntrinsics& intrinsics = lens.intrinsics();
    map.numbers.limit = {limitRad, radius, 1 + radius * radius, 0};
    map.numbers.pixels = glm::vec4(intrinsics.principalPx + 0.5, intrinsics.focalPx);
    map.numbers.tilt = rowsOf(lens.tilt());
    copyTerms(lens.terms(), map.numbers.terms);
}

// False for a lens that there is no formula for.
bool useLens(const Lens& lens, glm::dvec2 sizePx, ScreenMap& map) {
    if (const auto* radial = dynamic_cast<const RadialLens*>(&lens)) {
        useRadial(*radial, map);
    } else if (const auto* pinhole = dynamic_cast<const PinholeLens*>(&lens)) {
        usePinhole(*pinhole, sizePx, map);
    } else if (const auto* panorama = dynamic_cast<const EquirectangularLens*>(&lens)) {
        map.defines = {"EQUIRECTANGULAR"};
        map.numbers.pixels = glm::vec4(0.5 * sizePx, pxPerRad(panorama->columns(), panorama->rows()));
        map.numbers.size.z = static_cast<float>(turnPx(panorama->columns()));
    } else if (const auto* slices = dynamic_cast<const SphereSlicesLens*>(&lens)) {
        map.defines = {"SPHERE_SLICES"};
        map.numbers.pixels = glm::vec4(0.5 * sizePx, pxPerRad(slices->columns(), slices->rows()));
        map.numbers.size.w = static_cast<float>(turnPx(slices->rows()));
    } else {
        return false;
    }
    return true;
}

// Where positions jump, in the frame of a lens: at the poles of what turns around an axis, and straight
// behind round maps, which go on to there in every direction.
std::vector<glm::dvec3> jumpsOf(const ScreenMap& map) {
    if (map.numbers.size.z > 0) return {{0, 1, 0}, {0, -1, 0}};
    if (map.numbers.size.w > 0) return {{1, 0, 0}, {-1, 0, 0}};
    return {{0, 0, 1}};
}

// `inWall` gives the direction from the eye of one in the map's frame.
template <class InWall>
void tearWhereItJumps(ScreenMap& map, const InWall& inWall) {
    const std::vector<glm::dvec3> jumps = jumpsOf(map);
    for (size_t i = 0; i < jumps.size(); ++i)
        map.numbers.torn.at(i) = glm::vec4(glm::normalize(inWall(jumps[i])), 1);
}

void useCylinder(const CylinderProjection& cylinder, glm::dvec2 sizePx, ScreenMap& map) {
    map.defines = {"CYLINDER"};
    const CylinderWall& wall = cylinder.wall();
    map.numbers.displayFromWall = rowsOf(glm::transpose(cylinder.worldFromCylinder()));
    map.numbers.eyeOnSurface = glm::vec4(cylinder.eyeInCylinderM(), wall.radiusM);
    map.numbers.pixels = glm::vec4(0.5 * sizePx, sizePx.x / wall.arcRad, -sizePx.y / wall.heightM);
    map.numbers.size.z = static_cast<float>(turnPx({wall.arcRad, sizePx.x}));
    tearWhereItJumps(map, [&](glm::dvec3 jump) { return cylinder.worldFromCylinder() * jump; });
}

bool useLensAtInfinity(const LensProjection& projection, glm::dvec2 sizePx, ScreenMap& map) {
    if (!useLens(projection.lens(), sizePx, map)) return false;
    map.numbers.displayFromWall = rowsOf(glm::transpose(projection.worldFromLens()));
    tearWhereItJumps(map, [&](glm::dvec3 jump) { return projection.worldFromLens() * jump; });
    return true;
}

bool useLensInDome(const DomeProjection& projection, glm::dvec2 sizePx, ScreenMap& map) {
    if (!useLens(projection.lens(), sizePx, map)) return false;
    map.defines.emplace_back("ON_SPHERE");
    const glm::dmat3 lensFromWall = glm::transpose(projection.worldFromLens());
    const DomeSurface& dome = projection.dome();
    const glm::dvec3 lensOnDome = projection.lensM() - dome.centerM;
    map.numbers.displayFromWall = rowsOf(lensFromWall);
    map.numbers.eyeOnSurface = glm::vec4(lensFromWall * (projection.eyeM() - dome.centerM), dome.radiusM);
    map.numbers.lensOnSurface = glm::vec4(lensFromWall * lensOnDome, 0);
    tearWhereItJumps(map, [&](glm::dvec3 jump) {
        const glm::dvec3 ray = projection.worldFromLens() * jump;
        return projection.lensM() + maths::sphereDistance(dome.radiusM, lensOnDome, ray) * ray -
               projection.eyeM();
    });
    return true;
}

void useTable(const PositionTable& table, double widestRad, ScreenMap& map) {
    map.defines = {"TABLE"};
    if (table.chart.isPlane) map.defines.emplace_back("PLANE_CHART");
    ScreenMapNumbers& numbers = map.numbers;
    numbers.displayFromWall = rowsOf(table.chart.chartFromWall);
    const double radius = std::tan(widestRad);
    numbers.limit = {widestRad, radius, 1 + radius * radius, 0};
    numbers.pixels = {0, 0, 1, 1};
    numbers.tableBox = glm::vec4(table.least, table.nodesPerUnit);
    numbers.beyondTable = glm::vec4(table.pxFromChart[0], table.pxFromChart[1]);
    map.tableNodes = table.nodes;
    map.table.assign(table.px.begin(), table.px.end());
    tearWhereItJumps(map, [&](glm::dvec3 jump) { return glm::transpose(table.chart.chartFromWall) * jump; });
}

struct Cone {
    glm::dvec3 axis{0, 0, -1};
    double halfRad = kPi;

    // Of what the display shows. Its axis is not the best one, but all rays are within.
    static Cone about(const PixelRays& rays, std::optional<glm::dvec3> axis = std::nullopt) {
        glm::dvec3 sum(0);
        double least = 1;
        const auto forEach = [&rays](const auto& use) {
            for (int y = 0; y < rays.sizePx().y; ++y)
                for (int x = 0; x < rays.sizePx().x; ++x)
                    if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray))
                        use(glm::normalize(ray));
        };
        if (!axis) {
            forEach([&](glm::dvec3 ray) { sum += ray; });
            if (!(glm::length(sum) > 1e-6)) return {};
            axis = glm::normalize(sum);
        }
        forEach([&](glm::dvec3 ray) { least = std::min(least, glm::dot(*axis, ray)); });
        return {*axis, std::acos(std::clamp(least, -1.0, 1.0))};
    }
};

// A camera texture has its table on the plane of its base image, as far as that plane goes.
DirectionChart chartFor(const Projection& projection, const Cone& seen) {
    if (const auto* texture = dynamic_cast<const CameraTexture*>(&projection))
        if (const auto* base = dynamic_cast<const FrustumProjection*>(&texture->base()))
            return {chartFromWallAbout(glm::normalize(glm::transpose(base->pixelFromRay())[2])), true};
    return {chartFromWallAbout(seen.axis), false};
}

void chooseMap(const Display& display, const PixelRays& rays, const Cone& seen, ScreenMap& map) {
    const Projection* projection = display.projection.get();
    while (const auto* cropped = dynamic_cast<const CroppedProjection*>(projection))
        projection = &cropped->picture();
    const glm::dvec2 sizePx(display.sizePx);
    if (const auto* planar = dynamic_cast<const PlanarProjection*>(projection))
        return useProjective(planar->pixelFromRay(), map);
    if (const auto* frustum = dynamic_cast<const FrustumProjection*>(projection))
        return useProjective(frustum->pixelFromRay(), map);
    if (const auto* cylinder = dynamic_cast<const CylinderProjection*>(projection))
        return useCylinder(*cylinder, sizePx, map);
    if (const auto* lens = dynamic_cast<const LensProjection*>(projection))
        if (useLensAtInfinity(*lens, sizePx, map)) return;
    if (const auto* dome = dynamic_cast<const DomeProjection*>(projection))
        if (useLensInDome(*dome, sizePx, map)) return;
    const DirectionChart chart = chartFor(*projection, seen);
    constexpr double kMarginRad = 0.02;
    const double widestRad = Cone::about(rays, -glm::transpose(chart.chartFromWall)[2]).halfRad + kMarginRad;
    useTable(samplePositions(display, rays, chart), std::min(widestRad, kPi), map);
}

}  // namespace

ScreenMap screenMapOf(const Display& display, const PixelRays& rays) {
    ScreenMap map;
    ScreenMapNumbers& numbers = map.numbers;
    const Cone seen = Cone::about(rays);
    chooseMap(display, rays, seen, map);
    // Pixels reach beyond their centres, and straight lines into the display from beside it: at 45 degrees
    // around a round picture by 8% of its radius, which is a small angle but where wide lenses are flat.
    constexpr double kMarginRad = 0.02, kReach = 1.15, kWideRad = 100 * kPi / 180;
    const double halfRad = seen.halfRad > kWideRad ? kPi : std::min(kReach * seen.halfRad + kMarginRad, kPi);
    numbers.seenCone = glm::vec4(seen.axis, std::cos(halfRad));
    numbers.size.x = static_cast<float>(display.sizePx.x);
    numbers.size.y = static_cast<float>(display.sizePx.y);
    const auto middle = display.projection->unproject(glm::dvec2(display.sizePx) / 2.0);
    numbers.finish.x = static_cast<float>(1 / (middle ? glm::length(*middle) : 1.0));
    return map;
}

GpuScreenMap uploadScreenMap(const ScreenMap& map) {
    GpuScreenMap gpu{map.defines, map.numbers, {}};
    if (map.table.empty()) return gpu;
    gpu.table = makeTexture2D(GL_RG32F, map.tableNodes);
    glTextureSubImage2D(gpu.table.id(), 0, 0, 0, map.tableNodes.x, map.tableNodes.y, GL_RG, GL_FLOAT,
                        map.table.data());
    return gpu;
}

}  // namespace curvewall
