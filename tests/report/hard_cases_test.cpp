// The numerical stability suite at small size: what breaks is known, and what is known breaks.

#include "report/hard_cases/known_limits.h"
#include "report/hard_cases/suite.h"
#include "tests/support/gl_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>

namespace curvewall {

void PrintTo(const HardCaseFamily& family, std::ostream* out) { *out << family.name; }
void PrintTo(const KnownLimit& limit, std::ostream* out) { *out << limit.family << ", " << limit.methods; }

namespace {

// Without bounded-raycast's quads, for their shaders take long to compile; bounded_triangles_test.cpp draws
// with them.
const std::vector<std::string> kMethods{"piecewise", "image-based, cube", "bounded-raycast, triangle",
                                        "vertex-warp, 4 px"};

void expectNothingUnexplained(const HardCaseFamily& family, const FamilyResult& run) {
    for (const CaseTruth& truth : run.truths)
        EXPECT_LE(truth.check.wrongPixels, 0.001 * static_cast<double>(truth.check.checkedPixels))
            << truth.value;
    for (const CaseResult& result : run.results) {
        EXPECT_NE(result.outcome, Outcome::failed) << result.method << ": " << result.reason;
        EXPECT_EQ(result.outcome == Outcome::drawn, result.reason.empty());
        EXPECT_EQ(result.errors.nanTexels, 0u);
        if (result.isBroken() && !knownLimitOf(family, result))
            ADD_FAILURE() << result.method << " at " << result.value << ": " << result.fault << "; at most "
                          << result.errors.geometric.maxPx << " px, 99 in 100 "
                          << result.errors.geometric.p99Px << " px, " << 100 * result.faultyShare()
                          << " % at fault";
    }
}

void expectItIsThere(const KnownLimit& limit, const HardCaseFamily& family, const FamilyResult& run) {
    EXPECT_TRUE(std::ranges::any_of(run.results,
                                    [&](const CaseResult& result) {
                                        return result.isBroken() && knownLimitOf(family, result) == &limit;
                                    }))
        << limit.methods << " no longer breaks";
}

class HardCaseSuite : public test::GlTest, public testing::WithParamInterface<HardCaseFamily> {};

TEST_P(HardCaseSuite, BreaksWhereItIsKnownToAndNowhereElse) {
    const HardCaseFamily& family = GetParam();
    Renderer renderer(1);
    const FamilyResult run = runFamily(renderer, family, {96, {}, kMethods});
    expectNothingUnexplained(family, run);
    for (const KnownLimit& limit : knownLimits())
        if (limit.family == family.name && limit.isSeenSmall) expectItIsThere(limit, family, run);
}

std::string testNameOf(std::string name) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Families, HardCaseSuite, testing::ValuesIn(hardCaseFamilies()),
                         [](const auto& family) { return testNameOf(family.param.name); });

// What only large displays show.
class LargeHardCases : public test::GlTest, public testing::WithParamInterface<KnownLimit> {};

TEST_P(LargeHardCases, BreakNoWorseThanTheLimit) {
    const KnownLimit& limit = *std::ranges::find_if(knownLimits(), [](const KnownLimit& known) {
        return known.family == GetParam().family && known.methods == GetParam().methods &&
               known.from == GetParam().from;
    });
    const std::vector<HardCaseFamily> families = hardCaseFamilies();
    const HardCaseFamily& family = *std::ranges::find(families, limit.family, &HardCaseFamily::name);
    std::vector<std::string> methods = kMethods;
    std::erase_if(methods, [&](const std::string& method) { return !method.starts_with(limit.methods); });
    Renderer renderer(1);
    const FamilyResult run = runFamily(renderer, family, {512, {}, methods});
    expectNothingUnexplained(family, run);
    expectItIsThere(limit, family, run);
}

std::vector<KnownLimit> limitsOfLargeDisplays() {
    std::vector<KnownLimit> limits = knownLimits();
    std::erase_if(limits, [](const KnownLimit& limit) { return limit.isSeenSmall; });
    return limits;
}

INSTANTIATE_TEST_SUITE_P(Limits, LargeHardCases, testing::ValuesIn(limitsOfLargeDisplays()),
                         [](const auto& limit) {
                             return testNameOf(limit.param.family + "_" +
                                               (limit.param.methods.empty() ? "any" : limit.param.methods));
                         });

TEST(KnownLimits, AreOfFamiliesMethodsAndValuesThatThereAre) {
    const std::vector<HardCaseFamily> families = hardCaseFamilies();
    for (const KnownLimit& limit : knownLimits()) {
        const auto family = std::ranges::find(families, limit.family, &HardCaseFamily::name);
        ASSERT_NE(family, families.end()) << limit.family;
        EXPECT_NE(std::ranges::find(family->values, limit.from), family->values.end())
            << limit.family << ", " << limit.from;
        EXPECT_TRUE(std::ranges::any_of(hardCaseMethods(), [&](const HardCaseMethod& method) {
            return method.name.starts_with(limit.methods);
        })) << limit.methods;
    }
}

TEST(HardCaseFamilies, AreManyAndHaveNamesOfTheirOwn) {
    std::vector<std::string> names;
    for (const HardCaseFamily& family : hardCaseFamilies()) {
        names.push_back(family.name);
        EXPECT_LT(family.pictured, family.values.size()) << family.name;
    }
    EXPECT_GE(names.size(), 20u);
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

}  // namespace
}  // namespace curvewall
