#include "calibration/readers/wall_reader.h"
#include "renderer/scene/scene_building.h"
#include "report/hard_cases/hard_cases_document.h"
#include "report/hard_cases/known_limits.h"
#include "report/hard_cases/results.h"
#include "report/hard_cases/suite.h"
#include "report/hard_cases/truth_check.h"
#include "report/hard_cases/wrong_pixels.h"
#include "report/kept_json.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(20, 10);

Frame filled(int channels, float value) {
    return {kSizePx, channels,
            std::vector<float>(static_cast<size_t>(kSizePx.x * kSizePx.y * channels), value)};
}

float& texel(Frame& frame, int x, int y) {
    return frame.texels[static_cast<size_t>((y * frame.sizePx.x + x) * frame.channels)];
}

TEST(WrongPixels, AreThoseThatNoNeighbourOfTheTruthExplains) {
    Frame truth = filled(3, 0.2f), drawn = truth;
    texel(truth, 5, 5) = 0.9f;
    texel(drawn, 6, 4) = 0.9f;  // a pixel aside
    EXPECT_EQ(wrongPixels(drawn, truth, false), 0u);
    texel(drawn, 7, 5) = 0.9f;  // two
    EXPECT_EQ(wrongPixels(drawn, truth, false), 1u);
}

TEST(WrongPixels, LookAcrossTheSeamOfAClosedDisplay) {
    Frame truth = filled(3, 0.2f), drawn = truth;
    texel(truth, 0, 5) = 0.9f;
    texel(drawn, kSizePx.x - 1, 5) = 0.9f;
    EXPECT_EQ(wrongPixels(drawn, truth, true), 0u);
    EXPECT_EQ(wrongPixels(drawn, truth, false), 1u);
}

TEST(GapPixels, AreThoseWithFewerSurfacesThanTheTruthHasAllAround) {
    Frame truth = filled(1, 2), drawn = truth;
    texel(drawn, 5, 5) = 1;
    EXPECT_EQ(gapPixels(drawn, truth, false), 1u);
    texel(truth, 6, 6) = 1;
    EXPECT_EQ(gapPixels(drawn, truth, false), 0u);
}

// A square 2 m ahead of a flat screen of 90 degrees.
class TruthChecks : public ::testing::Test {
protected:
    TruthChecks() {
        Wall wall = test::shippedWall("planar-90");
        Scene scene;
        startMaterial(scene, plainMaterial({1, 1, 1}));
        addFrontalSquare(scene, {0, 0, -2}, 1);
        tried_ = {std::make_shared<const Wall>(std::move(wall)),
                  std::make_shared<const Scene>(std::move(scene)),
                  {}};
        RenderRequest request;
        request.wall = tried_.wall;
        request.scene = tried_.scene;
        request.method = Method::reference;
        request.output = OutputKind::position;
        position_ = Renderer().render(request).frame;
    }

    HardCase tried_;
    Frame position_;
};

TEST_F(TruthChecks, AgreeWithTheReference) {
    const TruthCheck check = checkTruth(position_, tried_);
    EXPECT_EQ(check.checkedPixels, static_cast<uint64_t>(position_.sizePx.x * position_.sizePx.y));
    EXPECT_EQ(check.wrongPixels, 0u);
    EXPECT_LT(check.doubtfulPixels, check.checkedPixels / 100);
}

TEST_F(TruthChecks, SeeAPointThatIsMissingMovedOrTooMany) {
    const int x = position_.sizePx.x / 2 + 3, y = position_.sizePx.y / 2 - 7;
    texel(position_, x, y) = std::nanf("");
    EXPECT_EQ(checkTruth(position_, tried_).wrongPixels, 1u);
    for (int i = 0; i < 3; ++i) (&texel(position_, x + 1, y))[i] *= 1.01f;
    EXPECT_EQ(checkTruth(position_, tried_).wrongPixels, 2u);
    for (int i = 0; i < 3; ++i) (&texel(position_, 1, 1))[i] = 3;
    EXPECT_EQ(checkTruth(position_, tried_).wrongPixels, 3u);
}

FamilyResult someResult() {
    const HardCaseFamily family = hardCaseFamilies().front();
    FamilyResult result{family.name, 96, {}, {}, {{"a.png", "a picture"}}};
    for (const double value : family.values) {
        result.truths.push_back({value, "", {100, 2, 1}, 0.5});
        for (const HardCaseMethod& method : hardCaseMethods()) result.results.push_back({value, method.name});
    }
    CaseResult& broken = result.results.front();
    broken.errors.geometric.maxPx = 3;
    broken.errors.image.psnrDb = std::numeric_limits<double>::infinity();
    broken.errors.coverage.twiceCoveredPixels = 7;
    broken.fault = "off by 3 px";
    result.results[1].outcome = Outcome::refused;
    result.results[1].reason = "not that";
    return result;
}

TEST(HardCaseResults, SurviveTheRoundTripThroughJson) {
    const FamilyResult result = someResult();
    const nlohmann::json json = nlohmann::json::parse(toJson(result).dump());
    EXPECT_EQ(toJson(familyResultFromJson(json)), toJson(result));
    EXPECT_EQ(familyResultFromJson(json).results[1].reason, "not that");
    EXPECT_TRUE(std::isinf(familyResultFromJson(json).results[0].errors.image.psnrDb));
    EXPECT_THROW(familyResultFromJson({{"family", "half"}}), nlohmann::json::exception);
}

TEST(HardCasesDocument, SaysWhereMethodsBreak) {
    const FamilyResult result = someResult();
    const Document document = hardCasesDocument({result});
    const auto& summary = std::get<Table>(document.blocks.at(1));
    ASSERT_EQ(summary.rows.size(), 1u);
    EXPECT_EQ(summary.rows[0][1], "breaks at 1");
    EXPECT_EQ(summary.rows[0][2], "refused at 1");
    EXPECT_EQ(summary.rows[0][3], "fine to the end");
    for (const Block& block : document.blocks) {
        const auto* const table = std::get_if<Table>(&block);
        if (!table) continue;
        for (const std::vector<std::string>& row : table->rows) EXPECT_EQ(row.size(), table->columns.size());
    }
}

TEST(KnownLimits, ExplainWhatIsNoWorseThanTheyAre) {
    const std::vector<HardCaseFamily> families = hardCaseFamilies();
    for (const KnownLimit& limit : knownLimits()) {
        if (limit.methods.empty()) continue;  // others may explain it, too
        const HardCaseFamily& family = *std::ranges::find(families, limit.family, &HardCaseFamily::name);
        CaseResult worst{limit.from, limit.methods};
        worst.errors.geometric.maxPx = limit.maxPx;
        worst.errors.geometric.p99Px = limit.p99Px;
        worst.displayPixels = 1'000'000;
        worst.wrongPixels = static_cast<uint64_t>(limit.faultyShare * 1e6);
        EXPECT_EQ(knownLimitOf(family, worst), &limit) << limit.family;

        const auto explains = [&](auto makeWorse) {
            CaseResult result = worst;
            makeWorse(result);
            return knownLimitOf(family, result) == &limit;
        };
        EXPECT_FALSE(explains([](CaseResult& r) { r.errors.geometric.maxPx *= 1.01; })) << limit.family;
        EXPECT_FALSE(explains([](CaseResult& r) { r.errors.geometric.p99Px *= 1.01; })) << limit.family;
        EXPECT_FALSE(explains([](CaseResult& r) { r.gapPixels = r.wrongPixels + 10; })) << limit.family;
        EXPECT_FALSE(explains([](CaseResult& r) { r.errors.nanTexels = 1; })) << limit.family;
        EXPECT_FALSE(explains([](CaseResult& r) { r.outcome = Outcome::failed; })) << limit.family;
        const auto place = std::ranges::find(family.values, limit.from);
        if (place == family.values.begin()) continue;
        EXPECT_FALSE(explains([&](CaseResult& r) { r.value = *(place - 1); })) << limit.family;
    }
}

class RunSuite : public test::GlTest {};

TEST_F(RunSuite, GivesTheSameResultsAgainAndWritesPictures) {
    const test::TemporaryFolder folder;
    HardCaseFamily family = hardCaseFamilies().back();
    const SuiteOptions options{16, folder.path("out"), {"piecewise", "image-based, cube"}};
    Renderer first, second;
    const FamilyResult once = runFamily(first, family, options);
    EXPECT_EQ(toJson(once), toJson(runFamily(second, family, options)));
    ASSERT_FALSE(once.pictures.empty());
    for (const CasePicture& picture : once.pictures)
        EXPECT_TRUE(std::ifstream(folder.path("out/" + picture.file)).good()) << picture.file;
}

// Two small families that count how often a case of theirs is made.
class KeptFamilies : public test::GlTest {
protected:
    KeptFamilies() {
        const HardCaseFamily easy = hardCaseFamilies().front();
        for (const char* name : {"one", "other"}) {
            HardCaseFamily family = easy;
            family.name = name;
            family.values.resize(2);
            family.pictured = 0;
            family.make = [this, easy](double value, int sizePx) {
                ++made_;
                return easy.make(value, sizePx);
            };
            families_.push_back(family);
        }
    }
    // As text, and how many cases were made.
    std::pair<std::string, int> run(const OnProgress& onProgress = [](const Progress&) {}) {
        made_ = 0;
        std::string text;
        for (const FamilyResult& result : runFamilies(families_, options_, onProgress))
            text += toJson(result).dump();
        return {text, made_};
    }
    std::string fileOfOne() const { return folder_.path("hard-case-one.json"); }

    test::TemporaryFolder folder_;
    SuiteOptions options_{16, folder_.path(), {"piecewise"}};
    std::vector<HardCaseFamily> families_;
    int made_ = 0;
};

TEST_F(KeptFamilies, AreNotRunAgain) {
    const auto [once, made] = run();
    EXPECT_EQ(made, 4);
    EXPECT_EQ(run(), std::pair(once, 0));
}

TEST_F(KeptFamilies, AreRunAgainWhereTheirFileOrPictureIsDamagedOrLost) {
    const auto [once, made] = run();
    std::filesystem::resize_file(fileOfOne(), 100);
    EXPECT_EQ(run(), std::pair(once, 2));
    std::filesystem::remove(fileOfOne());
    EXPECT_EQ(run(), std::pair(once, 2));
    std::filesystem::remove(folder_.path("hard-case-other-piecewise.png"));
    EXPECT_EQ(run(), std::pair(once, 2));
    EXPECT_EQ(run(), std::pair(once, 0));
}

TEST_F(KeptFamilies, OfAnotherMachineOrRunAreRunAgain) {
    const auto [once, made] = run();
    const nlohmann::json kept = keptJson(fileOfOne()).value();
    for (const char* part : {"program", "processor", "gl_renderer", "gl_version"}) {
        nlohmann::json other = kept;
        ASSERT_TRUE(other["key"][part].is_string()) << part;
        other["key"][part] = "another";
        keepJson(fileOfOne(), other);
        EXPECT_EQ(run(), std::pair(once, 2)) << part;
    }
    options_.sizePx = 20;
    EXPECT_EQ(run().second, 4);
}

TEST_F(KeptFamilies, AreNoPartOfTheTimeThatIsLeft) {
    std::vector<Progress> all;
    const auto note = [&](const Progress& progress) { all.push_back(progress); };
    run(note);
    ASSERT_EQ(all.size(), 4u);
    const double fourMs = all.front().leftMs;
    std::filesystem::remove(folder_.path("hard-case-other.json"));
    all.clear();
    run(note);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.front().done, 2u);
    EXPECT_EQ(all.front().all, 4u);
    EXPECT_EQ(all.front().leftMs, fourMs / 2);  // a guess for each
}

}  // namespace
}  // namespace curvewall
