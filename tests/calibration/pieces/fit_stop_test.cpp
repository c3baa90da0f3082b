#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <atomic>

namespace curvewall {
namespace {

// A cylinder that asks for a stop at the given call.
class StoppingProjection : public Projection {
public:
    StoppingProjection(ProjectionPtr projection, int stopsAt, std::stop_source stop)
        : projection_(std::move(projection)), stopsAt_(stopsAt), stop_(std::move(stop)) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        if (++calls_ == stopsAt_) stop_.request_stop();
        return projection_->unproject(px);
    }
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override { return projection_->project(ray); }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override { return projection_->seenFrom(eyeM); }
    int calls() const { return calls_; }

private:
    ProjectionPtr projection_;
    int stopsAt_;
    mutable std::stop_source stop_;
    mutable std::atomic<int> calls_ = 0;
};

constexpr glm::ivec2 kSizePx{200, 100};
constexpr int kPixels = 200 * 100;

std::stop_token stopped() {
    std::stop_source stop;
    stop.request_stop();
    return stop.get_token();
}

TEST(FitStop, EndsTheFitWhereverItIs) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const StoppingProjection whole(wall.displays[0].projection, 0, {});
    fitPieces(whole, kSizePx, 0.05);
    ASSERT_GT(whole.calls(), kPixels);
    const int calls = whole.calls();
    for (const int stopsAt : {1, calls / 4, calls / 2, calls - kPixels / 4}) {
        const std::stop_source stop;
        const StoppingProjection projection(wall.displays[0].projection, stopsAt, stop);
        EXPECT_THROW(fitPieces(projection, kSizePx, 0.05, stop.get_token()), FitStopped) << stopsAt;
        EXPECT_LT(projection.calls(), whole.calls()) << stopsAt;
    }
}

TEST(FitStop, EndsEachKindOfFit) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const Projection& projection = *wall.displays[0].projection;
    const std::stop_token stop = stopped();
    EXPECT_THROW(PixelRays(projection, kSizePx).keep(stop), FitStopped);
    EXPECT_THROW(fitCells(projection, kSizePx, 0.5, stop), FitStopped);
    EXPECT_THROW(certifyPieces(projection, PieceMesh{kSizePx, {}, {}}, stop), FitStopped);
    EXPECT_THROW(QuadGridSearch(projection, kSizePx, 0.5, stop).coarsest(), FitStopped);
}

}  // namespace
}  // namespace curvewall
