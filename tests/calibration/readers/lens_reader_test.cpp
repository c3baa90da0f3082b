#include "calibration/readers/lens_reader.h"

#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/round_trip.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace curvewall {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class LensReader : public ::testing::Test {
protected:
    ProjectionPtr read(const std::string& projection) {
        std::ofstream(folder_.path("wall.json"))
            << R"({"wall": "w", "displays": [{"name": "d", "size": [800, 600], "projection": {)" << projection
            << "}}]}";
        return readWall(folder_.path("wall.json")).displays.at(0).projection;
    }
    std::string complaintAbout(const std::string& projection) {
        try {
            read(projection);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing";
    }

private:
    test::TemporaryFolder folder_;
};

const std::string kRadial = R"("type": "radial", "fov_deg": 180, "model": )";
const std::string kPolynomial =
    R"("type": "radial", "model": "polynomial", "fov_deg": 180, "coefficients": )";
const std::string kCamera =
    R"("type": "camera", "focal_px": [500, 510], "principal_px": [399.5, 299.5], "model": )";

TEST_F(LensReader, AnglesAreDegreesAndPosesApply) {
    const ProjectionPtr radial = read(kRadial + R"("equidistant", "yaw_deg": 90)");
    EXPECT_LT(glm::distance(*radial->unproject({400, 300}), glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(*radial->unproject({700, 300}), glm::dvec3(0, 0, 1)), 1e-12);
    const ProjectionPtr panorama =
        read(R"("type": "equirectangular", "horizontal_fov_deg": 180, "vertical_fov_deg": 90)");
    EXPECT_LT(glm::distance(*panorama->unproject({800, 300}), glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_NEAR(panorama->unproject({400, 0})->y, std::sqrt(0.5), 1e-12);
    const ProjectionPtr slices =
        read(R"("type": "sphere_slices", "horizontal_fov_deg": 90, "vertical_fov_deg": 180)");
    EXPECT_NEAR(slices->unproject({800, 300})->x, std::sqrt(0.5), 1e-12);
    EXPECT_LT(glm::distance(*slices->unproject({400, 0}), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_EQ(read(R"("type": "curvilinear", "fov_deg": 90)")->project({0, 0, -1}).at(0),
              glm::dvec2(400, 300));
}

TEST_F(LensReader, CamerasCountPixelsFromTheCentreOfTheFirst) {
    for (const char* model : {"\"pinhole\"", "\"fisheye\""}) {
        const ProjectionPtr camera = read(kCamera + model);
        EXPECT_LT(glm::distance(*camera->unproject({400, 300}), glm::dvec3(0, 0, -1)), 1e-15);
        EXPECT_GT(camera->unproject({400, 100})->y, 0);
    }
    EXPECT_LT(glm::distance(read(kCamera + "\"pinhole\"")->project({1, 1, -2}).at(0), glm::dvec2(650, 45)),
              1e-9);
}

TEST_F(LensReader, ASurfacePutsThePictureInPlace) {
    const std::string dome = R"(, "surface": {"type": "sphere", "center": [0, 0, 0], "radius": 5})";
    const ProjectionPtr projection = read(kCamera + R"("pinhole", "center": [0, 0, 4])" + dome);
    EXPECT_LT(glm::distance(*projection->unproject({400, 300}), glm::dvec3(0, 0, -5)), 1e-12);
    for (const std::string& lens :
         {kRadial + R"("equisolid")", std::string(R"("type": "curvilinear", "fov_deg": 90)"),
          std::string(R"("type": "equirectangular", "horizontal_fov_deg": 180, "vertical_fov_deg": 90)"),
          std::string(R"("type": "sphere_slices", "horizontal_fov_deg": 180, "vertical_fov_deg": 90)")})
        EXPECT_NEAR(glm::length(*read(lens + dome)->unproject({420, 300})), 5, 1e-12);
}

TEST_F(LensReader, ErrorsNameTheFieldAndWhatWasExpected) {
    const std::string dome = R"("surface": {"type": "sphere", "center": [0, 0, 0], "radius": 5)";
    struct Case {
        std::string projection, field, expected;
    };
    const std::vector<Case> cases{
        {R"("type": "radial", "fov_deg": 180)", "model", "a value"},
        {kRadial + "\"fish\"", "model", "one of equidistant, equisolid, orthographic"},
        {R"("type": "radial", "model": "equidistant")", "fov_deg", "a value"},
        {R"("type": "radial", "model": "orthographic", "fov_deg": 180.1)", "fov_deg", "above 0, at most 180"},
        {R"("type": "radial", "model": "stereographic", "fov_deg": 360)", "fov_deg", "above 0, below 360"},
        {R"("type": "radial", "model": "equidistant", "fov_deg": 361)", "fov_deg", "at most 360"},
        {R"("type": "radial", "model": "equidistant", "fov_deg": 0)", "fov_deg", "above 0"},
        {kRadial + R"("equidistant", "coefficients": [1])", "", "only the keys"},
        {kRadial + R"("polynomial")", "coefficients", "a value"},
        {kPolynomial + "[]", "coefficients", "a list of 1, 2, 3, 4, 5, 6, 7, 8 or 9 numbers"},
        {kPolynomial + "[1,1,1,1,1,1,1,1,1,1]", "coefficients", "found a list of 10"},
        {kPolynomial + "[1, \"x\"]", "coefficients[1]", "a number"},
        {kPolynomial + "[-1]", "coefficients", "increases up to half of fov_deg"},
        {kPolynomial + "[0, 0]", "coefficients", "increases up to half of fov_deg"},
        {kPolynomial + "[1, 0, -0.2]", "coefficients", "stops increasing at 73.9"},
        {R"("type": "equirectangular", "horizontal_fov_deg": 1441, "vertical_fov_deg": 90)",
         "horizontal_fov_deg", "at most 1440"},
        {R"("type": "equirectangular", "horizontal_fov_deg": 90, "vertical_fov_deg": 181)",
         "vertical_fov_deg", "at most 180"},
        {R"("type": "sphere_slices", "horizontal_fov_deg": 181, "vertical_fov_deg": 90)",
         "horizontal_fov_deg", "at most 180"},
        {R"("type": "sphere_slices", "horizontal_fov_deg": 90, "vertical_fov_deg": 361)", "vertical_fov_deg",
         "at most 360"},
        {R"("type": "curvilinear", "fov_deg": 180)", "fov_deg", "above 0, below 180"},
        {R"("type": "camera", "model": "lens")", "model", "one of pinhole, fisheye"},
        {R"("type": "camera", "model": "pinhole", "principal_px": [1, 1])", "focal_px", "a value"},
        {R"("type": "camera", "model": "pinhole", "focal_px": [500, 0], "principal_px": [1, 1])",
         "focal_px[1]", "above 0"},
        {R"("type": "camera", "model": "pinhole", "focal_px": [500, 500])", "principal_px", "a value"},
        {kCamera + R"("pinhole", "distortion": [1, 2, 3])", "distortion", "0, 4, 5, 8, 12 or 14 numbers"},
        {kCamera + R"("fisheye", "distortion": [1, 2, 3, 4, 5])", "distortion", "0 or 4 numbers"},
        {kCamera + R"("pinhole", "distortion": [0,0,0,0,0,0,0,0,0,0,0,0,0,2])", "distortion[13]", "a tilt"},
        {kCamera + R"("pinhole", "distortion": {})", "distortion", "a list of"},
        {kRadial + R"("equidistant", "center": [0, 0, 1])", "center", "what has no surface"},
        {kRadial + R"("equidistant", "surface": 3)", "surface", "an object"},
        {kRadial + R"("equidistant", "surface": {})", "surface.type", "a value"},
        {kRadial + R"("equidistant", "surface": {"type": "cube"})", "surface.type", "one of sphere"},
        {kRadial + R"("equidistant", "surface": {"type": "sphere", "radius": 1})", "surface.center",
         "a value"},
        {kRadial + R"("equidistant", "surface": {"type": "sphere", "center": [0, 0, 0]})", "surface.radius",
         "a value"},
        {kRadial + R"("equidistant", )" + dome + R"(, "height": 2})", "surface", "only the keys"},
        {kRadial + R"("equidistant", "center": [5, 0, 0], )" + dome + "}", "",
         "the lens is not inside the dome"},
        {kRadial + R"("equidistant", "surface": {"type": "sphere", "center": [9, 0, 0], "radius": 5})", "",
         "not inside the dome"},
    };
    for (const Case& c : cases)
        EXPECT_THAT(complaintAbout(c.projection),
                    AllOf(HasSubstr("displays[0].projection" + (c.field.empty() ? "" : "." + c.field + ":")),
                          HasSubstr(c.expected)))
            << c.projection;
}

TEST_F(LensReader, ShippedWallsComeBackPixelByPixel) {
    for (const std::string& name : test::shippedWallNames()) {
        for (const Display& display : test::shippedWall(name).displays) {
            const auto result = test::roundTrip(
                *display.projection, display.sizePx, 1, [](glm::dvec2) { return false; },
                glm::dvec2(display.sizePx), 10'000);
            EXPECT_LT(result.worstPx, 1e-6) << name << ' ' << display.name;
            EXPECT_LT(result.holes, 2500) << name << ' ' << display.name;
        }
    }
}

}  // namespace
}  // namespace curvewall
