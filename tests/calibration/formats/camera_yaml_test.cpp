#include "calibration/formats/camera_yaml.h"

#include "calibration/errors.h"
#include "tests/support/round_trip.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

Wall wallOf(const std::string& text, const CalibrationRequest& request = {},
            nlohmann::json assume = nlohmann::json::object()) {
    Decisions decisions(std::move(assume));
    return readCalibration(
        {"camera.yml", text}, [](const std::string&) { return std::nullopt; }, request, decisions);
}

CalibrationRequest ofSize(glm::ivec2 sizePx) {
    CalibrationRequest request;
    request.sizePx = sizePx;
    return request;
}

struct OpenCvCamera {
    cv::Matx33d matrix;
    std::vector<double> distortion;
    bool isFisheye = false;
    cv::Vec3d rvec;

    std::string file(glm::ivec2 sizePx) const {
        cv::FileStorage file("camera.yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
        file << "image_width" << sizePx.x << "image_height" << sizePx.y << "flags" << 0;
        file << "fisheye_model" << isFisheye << "camera_matrix" << cv::Mat(matrix);
        file << "distortion_coefficients" << cv::Mat(distortion, true) << "rvec" << cv::Mat(rvec);
        file << "image_points" << cv::Mat::zeros(40, 88, CV_32FC2);
        return file.releaseAndGetString();
    }

    // The continuous pixel at which OpenCV sees a ray of the wall.
    glm::dvec2 pixel(glm::dvec3 ray) const {
        const std::vector<cv::Point3d> points{{ray.x, -ray.y, -ray.z}};
        std::vector<cv::Point2d> pixels;
        const cv::Vec3d origin(0, 0, 0);
        if (isFisheye)
            cv::fisheye::projectPoints(points, pixels, rvec, origin, matrix, distortion);
        else
            cv::projectPoints(points, rvec, origin, matrix, distortion, pixels);
        return {pixels[0].x + 0.5, pixels[0].y + 0.5};
    }
};

int whole(test::Random& random, int least, int most) {
    return std::min(most, static_cast<int>(random.uniform(least, most + 1.0)));
}

bool isRayOrHole(const std::optional<glm::dvec3>& ray) {
    return !ray || std::isfinite(ray->x + ray->y + ray->z);
}

class CamerasOfOpenCv : public ::testing::TestWithParam<std::pair<bool, std::vector<double>>> {};

TEST_P(CamerasOfOpenCv, SeeInEveryPixelTheRayThatOpenCvSeesThere) {
    const glm::ivec2 sizePx(1920, 1080);
    const auto& [isFisheye, distortion] = GetParam();
    test::Random random(7);
    for (int camera = 0; camera < 5; ++camera) {
        const OpenCvCamera truth{{random.uniform(1100, 1400), 0, random.uniform(900, 1000), 0,
                                  random.uniform(1100, 1400), random.uniform(500, 600), 0, 0, 1},
                                 distortion,
                                 isFisheye,
                                 {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}};
        const Wall wall = wallOf(truth.file(sizePx));
        ASSERT_EQ(wall.displays.size(), 1U);
        const Display& display = wall.displays.front();
        EXPECT_EQ(display.name, "camera");
        EXPECT_EQ(display.sizePx, sizePx);
        EXPECT_THAT(display.warnings, ::testing::IsEmpty());
        for (int i = 0; i < 500; ++i) {
            const glm::dvec2 px = random.pixel(sizePx);
            const auto ray = display.projection->unproject(px);
            ASSERT_TRUE(ray);
            ASSERT_LT(glm::distance(truth.pixel(*ray), px), 1e-6);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Camera, CamerasOfOpenCv,
    ::testing::Values(std::pair{false, std::vector<double>{0, 0, 0, 0, 0}},
                      std::pair{false, std::vector<double>{-0.21, 0.06, 0.0012, -0.0023, -0.012}},
                      std::pair{false,
                                std::vector<double>{0.35, 0.08, -0.001, 0.0007, 0.003, 0.62, 0.11, 0.005}},
                      std::pair{false, std::vector<double>{-0.2, 0.05, 0.001, 0.002, -0.004, 0.02, 0.01,
                                                           0.001, 0.003, -0.002, 0.0015, 0.001, 0.04, -0.07}},
                      std::pair{true, std::vector<double>{0.021, -0.0063, 0.0012, -0.0002}}));

TEST(CameraYaml, TheProjectorOfAPairLooksWhereItsRotationLeadsTheCamerasRays) {
    const cv::Matx33d camera(1100, 0, 640, 0, 1100, 400, 0, 0, 1),
        projector(1400, 0, 511, 0, 1400, 700, 0, 0, 1);
    const std::vector<double> none(5, 0.0);
    const cv::Vec3d rvec(0.1, -0.4, 0.05);
    cv::Matx33d rotation;
    cv::Rodrigues(rvec, rotation);
    cv::FileStorage file("pair.yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    file << "cam_K" << cv::Mat(camera) << "cam_kc" << cv::Mat(none, true) << "proj_K" << cv::Mat(projector)
         << "proj_kc" << cv::Mat(none, true) << "R" << cv::Mat(rotation) << "T"
         << cv::Mat(cv::Vec3d(0.3, 0, 0.4));
    const Wall wall = wallOf(file.releaseAndGetString(), ofSize({1024, 768}));
    ASSERT_EQ(wall.displays.size(), 2U);
    EXPECT_EQ(wall.displays[0].name, "cam");
    EXPECT_EQ(wall.displays[1].name, "proj");
    EXPECT_THAT(wall.displays[1].warnings, ::testing::Contains(HasSubstr("0.5 apart")));
    const OpenCvCamera truth{projector, none, false, rvec};
    const OpenCvCamera first{camera, none, false, {}};
    test::Random random(3);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 px = random.pixel({1024, 768});
        EXPECT_LT(glm::distance(truth.pixel(wall.displays[1].projection->unproject(px).value()), px), 1e-6);
        EXPECT_LT(glm::distance(first.pixel(wall.displays[0].projection->unproject(px).value()), px), 1e-6);
    }
}

// Rotations whose axis is OpenCV's in every kind of world are told apart by one ray each.
TEST(CameraYaml, WorldAxesAndTheSenseOfARotationCanBeGiven) {
    const std::string camera = "camera_matrix: [64, 0, 31.5, 0, 64, 31.5, 0, 0, 1]\n";
    const auto ahead = [&](const std::string& rotation, const nlohmann::json& assume) {
        return wallOf(camera + rotation, {}, assume).displays.at(0).projection->unproject({32, 32}).value();
    };
    const std::string lookingUp = "R: [1, 0, 0, 0, 0, -1, 0, 1, 0]\n";  // its z axis is the world's y
    EXPECT_LT(glm::distance(ahead(lookingUp, {{"world_axes", "y_ahead_z_up"}}), {0, 0, -1}), 1e-12);
    EXPECT_LT(glm::distance(ahead(lookingUp, {{"world_axes", "y_up_z_back"}}), {0, 1, 0}), 1e-12);
    EXPECT_LT(glm::distance(ahead(lookingUp, nlohmann::json::object()), {0, -1, 0}), 1e-12);
    EXPECT_LT(glm::distance(ahead(lookingUp, {{"rotation", "camera_to_world"}}), {0, 1, 0}), 1e-12);
    EXPECT_LT(glm::distance(ahead(lookingUp, {{"rotation", "ignored"}}), {0, 0, -1}), 1e-12);
    EXPECT_THROW(ahead(lookingUp, {{"rotation", "backwards"}}), FieldError);
}

TEST(CameraYaml, NamesInEveryWritingAreOneCamera) {
    const std::string numbers = "[64, 0, 31.5, 0, 64, 15.5, 0, 0, 1]\n";
    for (const char* name :
         {"camera_matrix", "cameraMatrix", "CameraMatrix", "M1", "K", "k", "cam_K", "mtx", "intrinsic_matrix",
          "camera_matrix_left", "proj_K", "projector_matrix", "K2", "Camera_Matrix"})
        EXPECT_EQ(wallOf(name + (": " + numbers)).displays.size(), 1U) << name;
    for (const char* name : {"kc", "keypoints", "matrices", "dist"})
        EXPECT_THROW(wallOf(name + (": " + numbers)), InputError) << name;
}

TEST(CameraYaml, WhateverTheBytesAreItReadsThemOrRefusesThem) {
    test::Random random(11);
    const fs::path folder = fs::path(CURVEWALL_SOURCE_DIR) / "tests/data/conformance/camera-yaml";
    int files = 0, refused = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".yml") continue;
        std::ostringstream bytes;
        bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        if (bytes.str().size() > 4000) continue;
        ++files;
        for (int i = 0; i < 60; ++i) {
            std::string damaged = bytes.str();
            for (int k = whole(random, 1, 4); k > 0; --k) {
                const auto at = static_cast<size_t>(whole(random, 0, static_cast<int>(damaged.size()) - 1));
                static const std::string kBytes = "[]{}:,-.e0123456789\n &*!%\"'\t?|>#\xff";
                switch (whole(random, 0, 3)) {
                    case 0:
                        damaged.resize(at + 1);
                        break;
                    case 1:
                        damaged.insert(at, damaged.substr(at / 2, 40));
                        break;
                    default:
                        damaged[at] = kBytes[static_cast<size_t>(
                            whole(random, 0, static_cast<int>(kBytes.size()) - 1))];
                }
            }
            try {
                for (const Display& display : wallOf(damaged).displays)
                    EXPECT_TRUE(isRayOrHole(display.projection->unproject({1.5, 1.5})));
            } catch (const InputError&) {
                ++refused;
            } catch (const FieldError&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(files, 20);
    EXPECT_GT(refused, 300);
}

TEST(CameraYaml, NestingAndSizeAreBounded) {
    for (const char* open : {"[", "{a: ", "- ", "? ", "&a [", "!!t {"}) {
        std::string text;
        for (int i = 0; i < 100'000; ++i) text += open;
        EXPECT_THROW(wallOf("camera_matrix: " + text), InputError) << open;
        EXPECT_THROW(wallOf(text), InputError) << open;
    }
    EXPECT_THROW(wallOf(std::string(size_t{9} << 20, ' ')), InputError);
}

}  // namespace
}  // namespace curvewall
