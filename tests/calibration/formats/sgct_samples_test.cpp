// Every real configuration: it loads, or is refused for the reason that the table says.

#include "calibration/errors.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/projections/pose.h"
#include "tests/support/sample_paths.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

struct Sample {
    const char* path;
    size_t displays;          // 0: refused
    const char* reason = "";  // a part of it
};

void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.path; }

constexpr const char* kNoMesh = ".mesh: expected the file ";

const std::vector<Sample> kSamples{
    {"sgct-configs/3DTV.json", 1},
    {"sgct-configs/Kinect.json", 1},
    {"sgct-configs/multi_window.json", 5},
    {"sgct-configs/single.json", 1},
    {"sgct-configs/single_cylindrical.json", 1},
    {"sgct-configs/single_equirectangular.json", 1},
    {"sgct-configs/single_fisheye.json", 1},
    {"sgct-configs/single_fisheye_fxaa.json", 1},
    {"sgct-configs/single_sbs_stereo.json", 1},
    {"sgct-configs/single_texturemapped.json", 1},
    {"sgct-configs/single_two_win.json", 2},
    {"sgct-configs/single_two_win_3D.json", 2},
    {"sgct-configs/spherical_mirror.json", 1},
    {"sgct-configs/spherical_mirror_4meshes.json", 1},
    {"sgct-configs/spout_output_cubemap.json", 6},
    {"sgct-configs/spout_output_equirectangular.json", 1},
    {"sgct-configs/spout_output_fisheye.json", 1},
    {"sgct-configs/two_nodes.json", 2},
    {"sgct-configs/docs-examples/anaglyph-stereo.json", 1},
    {"sgct-configs/docs-examples/cubemap-ndi.json", 6},
    {"sgct-configs/docs-examples/cubemap.json", 6},
    {"sgct-configs/docs-examples/cylindrical.json", 1},
    {"sgct-configs/docs-examples/equirectangular.json", 1},
    {"sgct-configs/docs-examples/fisheye-presentation.json", 1},
    {"sgct-configs/docs-examples/fisheye.json", 1},
    {"sgct-configs/docs-examples/highres.json", 1},
    {"sgct-configs/docs-examples/ndi.json", 1},
    {"sgct-configs/docs-examples/planar-asymmetric.json", 1},
    {"sgct-configs/docs-examples/planar-orientation.json", 1},
    {"sgct-configs/docs-examples/planar-symmetric.json", 1},
    {"sgct-configs/docs-examples/projectionplane.json", 1},
    {"sgct-configs/docs-examples/single.json", 1},
    {"sgct-configs/docs-examples/sphericalmirror.json", 1},
    {"sgct-configs/docs-examples/two-nodes.json", 2},
    {"sgct-configs/docs-examples/two-windows.json", 2},
    {"sgct-history/mpcdi_example1_distorted.xml", 1},
    {"sgct-history/mpcdi_example2_undistorted.xml", 1},
    {"sgct-history/config/dome/dome_alpha.xml", 7},
    {"sgct-history/config/dome/dome_alpha_no_SL.xml", 7},
    {"sgct-history/config/dome/dome_alpha_stereo.xml", 7},
    {"sgct-history/config/dome/dome_alpha_stereo_no_SL.xml", 7},
    {"sgct-history/config/dome/dome_beta.xml", 7},
    {"sgct-history/config/dome/dome_beta_no_SL.xml", 7},
    {"sgct-history/config/dome/dome_beta_stereo.xml", 7},
    {"sgct-history/config/dome/dome_beta_stereo_no_SL.xml", 7},
    {"sgct-history/config/dome/dome_bravo.xml", 7},
    {"sgct-history/config/dome/dome_bravo_pitch180.xml", 7},
    {"sgct-history/config/dome/dome_bravo_pitch90.xml", 7},
    {"sgct-history/config/dome/dome_bravo_stereo.xml", 7},
    {"sgct-history/config/dome/dome_bravo_stereo_fisheye3Dviewer.xml", 8},
    {"sgct-history/config/dome/dome_bravo_stereo_pitch90.xml", 7},
    {"sgct-history/config/dome/dome_bravo_stereo_window.xml", 7},
    {"sgct-history/config/dome/dome_sim.xml", 6},
    {"sgct-history/config/dome/dome_sushi.xml", 7},
    {"sgct-history/config/dome/dome_sushi_pitch90.xml", 7},
    {"sgct-history/config/dome/dome_sushi_test.xml", 6},
    {"sgct-history/config/dome/gamma_test.xml", 6},
    {"sgct-history/config/dome/simcad/dome_bravo.xml", 7},
    {"sgct-history/config/dome/simcad/dome_bravo_highres.xml", 7},
    {"sgct-history/config/dome/simcad/dome_bravo_stereo.xml", 7},
    {"sgct-history/config/dome/simcad/dome_sushi.xml", 7},
    {"sgct-history/config/dome/simcad/dome_sushi_test.xml", 6},
    {"sgct-history/config/dome/simcad/dome_sushi_test_4K.xml", 6},
    {"sgct-history/config/dome/simcad/dome_sushi_test_domeprojection.xml", 6},
    {"sgct-history/config/dome/simcad/dome_sushi_test_exports.xml", 6},
    {"sgct-history/config/dome/simcad/dome_sushi_test_sgc.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_alpha.xml", 7},
    {"sgct-history/config/dome/sciss/current/dome_alpha_noSL.xml", 7},
    {"sgct-history/config/dome/sciss/current/dome_alpha_stereo.xml", 7},
    {"sgct-history/config/dome/sciss/current/dome_alpha_stereo_noSL.xml", 7},
    {"sgct-history/config/dome/sciss/current/dome_alpha_stereo_small.xml", 7},
    {"sgct-history/config/dome/sciss/current/dome_gamma.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_gamma_6win.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_gamma_6win_stereo.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_gamma_no_fs.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_gamma_stereo.xml", 6},
    {"sgct-history/config/dome/sciss/current/dome_gamma_stereo_small.xml", 6},
    // The same without the meshes, which that commit does not have.
    {"sgct-dome-2020/config/dome/dome_alpha.xml", 7},
    {"sgct-dome-2020/config/dome/dome_alpha_no_SL.xml", 7},
    {"sgct-dome-2020/config/dome/dome_alpha_stereo.xml", 7},
    {"sgct-dome-2020/config/dome/dome_alpha_stereo_no_SL.xml", 7},
    {"sgct-dome-2020/config/dome/dome_beta.xml", 7},
    {"sgct-dome-2020/config/dome/dome_beta_no_SL.xml", 7},
    {"sgct-dome-2020/config/dome/dome_beta_stereo.xml", 7},
    {"sgct-dome-2020/config/dome/dome_beta_stereo_no_SL.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo_pitch180.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo_pitch90.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo_stereo.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo_stereo_fisheye3Dviewer.xml", 8},
    {"sgct-dome-2020/config/dome/dome_bravo_stereo_pitch90.xml", 7},
    {"sgct-dome-2020/config/dome/dome_bravo_stereo_window.xml", 7},
    {"sgct-dome-2020/config/dome/dome_sim.xml", 6},
    {"sgct-dome-2020/config/dome/dome_sushi.xml", 7},
    {"sgct-dome-2020/config/dome/dome_sushi_pitch90.xml", 7},
    {"sgct-dome-2020/config/dome/dome_sushi_test.xml", 6},
    {"sgct-dome-2020/config/dome/gamma_test.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/pfm/dome_sidebyside_test.xml", 2},
    {"sgct-dome-2020/config/dome/pfm/dome_sushi_test.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/pfm/dome_sushi_test_same_but_stereo.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/pfm/dome_sushi_test_same_view.xml", 6},
    {"sgct-dome-2020/config/dome/pfm/dome_sushi_test_u3.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_alpha.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_alpha_noSL.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_alpha_stereo.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_alpha_stereo_noSL.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_alpha_stereo_small.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma_6win.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma_6win_stereo.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma_no_fs.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma_stereo.xml", 0, kNoMesh},
    {"sgct-dome-2020/config/dome/sciss/current/dome_gamma_stereo_small.xml", 0, kNoMesh},
};

// The samples keep meshes of one kind together; some configurations of SGCT name them in a folder of theirs.
FindFile findIn(const fs::path& configuration) {
    const std::map<std::string, const char*> elsewhere{
        {"standard_16x9.data", "bourke/sgct_standard_16x9.data"},
        {"surface1.pfm", "sgct-master/surface1.pfm"}};
    return [=](const std::string& name) -> std::optional<FileBytes> {
        if (auto beside = filesBeside(configuration.string())(name)) return beside;
        fs::path path = test::samplesFolder() / "obj" / bareName(name);
        if (const auto found = elsewhere.find(bareName(name)); found != elsewhere.end())
            path = test::samplesFolder() / found->second;
        if (configuration.parent_path().filename() == "pfm" && path.extension() == ".pfm")
            path = configuration.parent_path() / "256_128" / bareName(name);
        if (!fs::exists(path)) return std::nullopt;
        return readFile(path.string(), "a sample");
    };
}

Wall readSample(const std::string& name, const std::string& display = "") {
    const fs::path path = test::samplesFolder() / name;
    Decisions decisions;
    return readCalibration(readFile(path.string(), "a sample"), findIn(path), {.display = display},
                           decisions);
}

class SgctSamples : public ::testing::TestWithParam<Sample> {
protected:
    void SetUp() override {
        if (!fs::is_directory(test::samplesFolder()))
            GTEST_SKIP() << "set CURVEWALL_SAMPLES to the folder of real calibrations";
    }
};

TEST_P(SgctSamples, LoadsOrIsRefusedForAReason) {
    const Sample& sample = GetParam();
    try {
        const Wall wall = readSample(sample.path);
        EXPECT_EQ(wall.displays.size(), sample.displays);
        for (const Display& display : wall.displays)
            EXPECT_TRUE(display.projection->unproject(glm::dvec2(display.sizePx) * 0.5)) << display.name;
    } catch (const InputError& error) {
        EXPECT_EQ(sample.displays, 0U) << error.what();
        EXPECT_THAT(error.what(), HasSubstr(sample.reason));
    }
}

std::string nameOf(const ::testing::TestParamInfo<Sample>& info) {
    std::string name = info.param.path;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Files, SgctSamples, ::testing::ValuesIn(kSamples), nameOf);

class SgctFacts : public SgctSamples {};
INSTANTIATE_TEST_SUITE_P(Facts, SgctFacts, ::testing::Values(Sample{"", 0}));

TEST_P(SgctFacts, EverySampleIsInTheTable) {
    for (const char* folder : {"sgct-configs", "sgct-history", "sgct-dome-2020"})
        for (const auto& entry : fs::recursive_directory_iterator(test::samplesFolder() / folder)) {
            const std::string extension = entry.path().extension().string();
            if ((extension != ".json" && extension != ".xml") ||
                entry.path().filename() == "sgct.schema.json")
                continue;
            const std::string path = fs::relative(entry.path(), test::samplesFolder()).string();
            EXPECT_TRUE(std::ranges::any_of(kSamples, [&](const Sample& s) { return s.path == path; }))
                << path;
        }
}

TEST_P(SgctFacts, AMeshThatDisagreesWithItsConfigurationIsReported) {
    const Wall wall = readSample("sgct-history/config/dome/simcad/dome_sushi_test_sgc.xml", "viewport1");
    ASSERT_EQ(wall.displays.size(), 1U);
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(640, 400));
    EXPECT_THAT(wall.displays[0].warnings, Contains(HasSubstr("up 70.238 instead of 74.100 degrees")));
}

// The view planes of 2013 were made for the dome as it stands, tilted, and the meshes for a level one.
TEST_P(SgctFacts, ViewPlanesOfOldXmlAreOtherFrustaThanThoseOfTheirMeshes) {
    const Wall wall = readSample("sgct-history/config/dome/sciss/current/dome_gamma_6win.xml", "Channel 1");
    EXPECT_THAT(wall.displays[0].warnings,
                Contains(HasSubstr("left -47.325 instead of -44.510 degrees, right 47.520 instead of 44.510 "
                                   "degrees, down -32.108 instead of -27.380 degrees, up 36.071 instead of "
                                   "33.740 degrees, turned by 30.708 degrees")));
}

// x in the order of the file: 0.24159 and 0.95250 are where the first node of channel 1 lands on the screen,
// y up, and it shows the top left node's centre of 128 x 128.
TEST_P(SgctFacts, TheFirstNodeOfAForwardMapLandsWhereTheFileSays) {
    const Wall wall = readSample("sgct-dome-2020/config/dome/pfm/dome_sushi_test_same_view.xml", "viewport4");
    const Display& channel1 = wall.displays[0];
    const glm::dvec2 px = glm::dvec2(0.241590, 1 - 0.952500) * glm::dvec2(channel1.sizePx);
    const auto ray = channel1.projection->unproject(px + glm::dvec2(1, 1));
    ASSERT_TRUE(ray);
    const double right = 1.6554, up = 2.7834, down = 0.1352;  // tangents: 58.865, 70.238, 7.701 degrees
    const glm::dvec2 node = {-right + 2 * right * 0.5 / 128, up - (up - down) * 0.5 / 128};
    const double half = std::sqrt(0.5);  // the heading is -45 degrees
    const glm::dvec3 truth = glm::normalize(glm::dvec3(half * node.x - half, node.y, -half * node.x - half));
    EXPECT_LT(glm::distance(glm::normalize(*ray), truth), 0.01);
}

TEST_P(SgctFacts, AnInverseMapStartsAtTheTopLeftOfTheScreen) {
    const Display display = readSample("sgct-configs/single_texturemapped.json").displays[0];
    EXPECT_EQ(display.sizePx, glm::ivec2(768, 810));
    // The first node, (0.24221, 0.99759) with y up, of the view that the configuration gives.
    const auto first = display.projection->unproject({0, 0});
    ASSERT_TRUE(first);
    const double right = std::tan(glm::radians(77.821993)), up = std::tan(glm::radians(78.435992));
    const glm::dvec3 inView(right * (2 * 0.24221 - 1), up * (2 * 0.99759 - 1), -1);
    const glm::dmat3 rotation = rotationFromOrientation(
        {glm::radians(301.504967), glm::radians(40.615664), glm::radians(-47.675061)});
    EXPECT_LT(glm::distance(glm::normalize(*first), glm::normalize(rotation * inView)), 1e-4);
}

}  // namespace
}  // namespace curvewall
