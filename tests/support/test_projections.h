#pragma once
// Projections simple enough to be checked by eye.

#include "calibration/pieces/pixel_rays.h"
#include "calibration/wall.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace curvewall {

// A flat screen at a distance in front of the eye, looking along -z.
class PinholeProjection : public Projection {
public:
    PinholeProjection(glm::ivec2 sizePx, double focalPx, double distanceM = 1)
        : centrePx_(glm::dvec2(sizePx) / 2.0), focalPx_(focalPx), distanceM_(distanceM) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        const glm::dvec2 offset = (px - centrePx_) / focalPx_;
        return distanceM_ * glm::dvec3(offset.x, -offset.y, -1);
    }
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override {
        if (ray.z >= 0) return {};
        return {centrePx_ + focalPx_ * glm::dvec2(ray.x, -ray.y) / -ray.z};
    }
    ProjectionPtr seenFrom(glm::dvec3) const override { return std::make_shared<PinholeProjection>(*this); }

private:
    glm::dvec2 centrePx_;
    double focalPx_;
    double distanceM_;
};

// A pixel sees whatever ray it is given; where there is none, it sees nothing.
class RayListProjection : public Projection {
public:
    RayListProjection(int widthPx, std::vector<std::optional<glm::dvec3>> rays)
        : widthPx_(widthPx), rays_(std::move(rays)) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        if (px.x < 0 || px.x >= widthPx_) return std::nullopt;
        const auto index = static_cast<size_t>(static_cast<int>(px.y) * widthPx_ + static_cast<int>(px.x));
        return px.y >= 0 && index < rays_.size() ? rays_[index] : std::nullopt;
    }
    std::vector<glm::dvec2> project(glm::dvec3) const override { return {}; }
    ProjectionPtr seenFrom(glm::dvec3) const override { return std::make_shared<RayListProjection>(*this); }

private:
    int widthPx_;
    std::vector<std::optional<glm::dvec3>> rays_;
};

// A position sees what a function says; nothing is known of the way back.
class RayFunctionProjection : public Projection {
public:
    using RayAt = std::function<std::optional<glm::dvec3>(glm::dvec2 px)>;
    explicit RayFunctionProjection(RayAt rayAt) : rayAt_(std::move(rayAt)) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override { return rayAt_(px); }
    std::vector<glm::dvec2> project(glm::dvec3) const override { return {}; }
    ProjectionPtr seenFrom(glm::dvec3) const override {
        return std::make_shared<RayFunctionProjection>(*this);
    }

private:
    RayAt rayAt_;
};

// The rays of pixels, with the projection that they come from.
class FunctionRays : public PixelRays {
public:
    FunctionRays(RayFunctionProjection::RayAt rayAt, glm::ivec2 sizePx)
        : FunctionRays(std::make_shared<RayFunctionProjection>(std::move(rayAt)), sizePx) {}

private:
    FunctionRays(const std::shared_ptr<const Projection>& projection, glm::ivec2 sizePx)
        : PixelRays(*projection, sizePx), projection_(projection) {}

    std::shared_ptr<const Projection> projection_;
};

// A wall of one display.
inline Wall wallOf(ProjectionPtr projection, glm::ivec2 sizePx) {
    Wall wall;
    wall.displays.push_back({"test", sizePx, "test", std::move(projection)});
    return wall;
}

inline Wall pinholeWall(glm::ivec2 sizePx, double focalPx, double distanceM = 1) {
    return wallOf(std::make_shared<PinholeProjection>(sizePx, focalPx, distanceM), sizePx);
}

}  // namespace curvewall
