// Every method on the displays of configs/: docs/methods.md says which of them it draws, and what it draws
// agrees with the reference.

#include "calibration/errors.h"
#include "renderer/render.h"
#include "renderer/shown_error.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

struct Variant {
    std::string column;  // of the table
    std::function<void(RenderRequest&)> choose;
    // Of the points shown, for 99 pixels in 100: near a pole of a display a texel, or the chord of a
    // triangle's edge, is worth many pixels.
    double p99Px;
    // Of pixels of flat colours, which only edges tell apart. None where the driver compiles for long for
    // every output, and bounded_raycast_test.cpp compares colours.
    std::optional<double> shareOff;
    std::string refusal{};  // what it says of a display that it does not draw
};

void chooseSource(RenderRequest& request, SourceKind source) {
    request.method = Method::imageBased;
    request.source = source;
}

// A linear filter spreads an edge over two pixels, and some pixels in a hundred are that near to one.
constexpr double kEdges = 0.05;

std::vector<Variant> variants() {
    return {
        {"piecewise", [](RenderRequest& request) { request.method = Method::piecewise; }, 0.25, 0.005},
        {"image-based, cube", [](RenderRequest& request) { chooseSource(request, SourceKind::cube); }, 0.75,
         kEdges},
        {"image-based, hemicube",
         [](RenderRequest& request) {
             chooseSource(request, SourceKind::hemicube);
             request.facePass = FacePass::layered;
             request.lookup = SourceLookup::mesh;
             request.meshStepPx = kLeastMeshStepPx;
         },
         1, kEdges, "a hemicube holds what lies within 90 degrees of its axis"},
        {"image-based, planar", [](RenderRequest& request) { chooseSource(request, SourceKind::planar); },
         0.75, kEdges, "a planar source holds what lies within 85 degrees of its axis"},
        {"bounded-raycast", [](RenderRequest& request) { request.method = Method::boundedRaycast; }, 0.01,
         std::nullopt,
         "bounded-raycast draws round lenses seen from the lens: radial, curvilinear, a fisheye camera"},
        {"vertex-warp",
         [](RenderRequest& request) {
             request.method = Method::vertexWarp;
             request.tessellationPx = 4;
         },
         0.25, 0.01, "vertex-warp moves every vertex to one place"},
        {"reference", [](RenderRequest& request) { request.method = Method::reference; }, 0.01, 0},
        {"auto", [](RenderRequest& request) { request.method = Method::automatic; }, 0.25, kEdges},
    };
}

// The first display of every wall, and others of another kind.
struct ShownDisplay {
    std::string wall, display;
};

std::vector<ShownDisplay> shownDisplays() {
    std::vector<ShownDisplay> shown;
    for (const std::string& wall : test::shippedWallNames()) {
        std::ifstream file(test::small_walls::kConfigs + wall + ".json");
        const auto description = nlohmann::json::parse(file);
        std::set<std::string> kinds;
        for (const auto& display : description["displays"]) {
            const auto& projection = display["projection"];
            const auto kind = projection["type"].get<std::string>() + projection.value("model", "");
            if (kinds.insert(kind).second) shown.push_back({wall, display["name"]});
        }
    }
    return shown;
}

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line.substr(1));
    for (std::string cell; std::getline(text, cell, '|');) {
        std::erase(cell, '`');
        const size_t first = cell.find_first_not_of(' ');
        cells.push_back(
            first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
    }
    return cells;
}

// What the page's table says of each "wall, display" and column.
std::map<std::string, std::map<std::string, std::string>> documentedCells() {
    std::map<std::string, std::map<std::string, std::string>> rows;
    std::vector<std::string> columns;
    std::ifstream page(CURVEWALL_SOURCE_DIR "/docs/methods.md");
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("| wall, display |")) columns = cellsOf(line);
        if (!line.starts_with('|')) columns.clear();  // the table has ended
        if (!line.starts_with("| `") || columns.empty()) continue;
        const std::vector<std::string> cells = cellsOf(line);
        for (size_t i = 1; i < std::min(cells.size(), columns.size()); ++i)
            rows[cells[0]][columns[i]] = cells[i];
    }
    return rows;
}

TEST(MethodsPage, HasARowForEveryWallAndAColumnForEveryMethod) {
    const auto rows = documentedCells();
    EXPECT_EQ(rows.size(), shownDisplays().size());
    for (const ShownDisplay& shown : shownDisplays())
        for (const Variant& variant : variants()) {
            const auto row = rows.find(shown.wall + ", " + shown.display);
            ASSERT_NE(row, rows.end()) << shown.wall << ", " << shown.display;
            ASSERT_TRUE(row->second.contains(variant.column)) << variant.column;
            EXPECT_THAT(row->second.at(variant.column), ::testing::AnyOf("yes", "no"));
        }
}

struct Case {
    ShownDisplay shown;
    Variant variant;

    std::string name() const { return shown.wall + "_" + shown.display + "_" + variant.column; }

    // There no texel is small enough, and the automatic size is the largest there is.
    bool hasPole() const { return shown.wall == "equirectangular" || shown.wall == "sphere-slices"; }

    // Of faces of 1024 px on displays of 256 px for 180 degrees.
    double p99Px() const {
        constexpr double kAtPolesPx = 3;
        return hasPole() && variant.column.starts_with("image-based") ? kAtPolesPx : variant.p99Px;
    }
};

void PrintTo(const Case& tried, std::ostream* out) { *out << tried.name(); }

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const ShownDisplay& shown : shownDisplays())
        for (const Variant& variant : variants()) all.push_back({shown, variant});
    return all;
}

class EveryMethod : public test::GlTest, public ::testing::WithParamInterface<Case> {
protected:
    // In a closed room, so that every pixel with a ray shows something.
    RenderRequest request() const {
        constexpr int kDivisor = 4;
        const Case& tried = GetParam();
        RenderRequest made = test::requestFor(test::smallShippedWall(tried.shown.wall, kDivisor),
                                              boxRoom({8, 5, 8}), {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}});
        made.display = tried.shown.display;
        made.style = Style::unlit;
        if (tried.hasPole()) made.faceSizePx = 1024;
        tried.variant.choose(made);
        return made;
    }
};

TEST_P(EveryMethod, AgreesWithTheReferenceOrSaysWhyNot) {
    const auto& [shown, variant] = GetParam();
    const bool isDrawn = documentedCells()[shown.wall + ", " + shown.display][variant.column] == "yes";
    RenderRequest asked = request();
    Renderer renderer;
    if (!isDrawn) {
        try {
            renderer.render(asked);
            FAIL() << "the page says that it does not draw this display";
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr(variant.refusal));
        }
        return;
    }
    if (variant.shareOff) {
        const Frame truth = test::referenceOf(asked).frame;
        EXPECT_LE(compareColor(renderer.render(asked).frame, truth).shareOff, *variant.shareOff);
    }
    asked.output = OutputKind::position;
    const Display& display = findDisplay(*asked.wall, asked.display);
    const Frame points = renderer.render(asked).frame, truePoints = test::referenceOf(asked).frame;
    EXPECT_LE(shownError(points, display).p99Px, GetParam().p99Px());
    EXPECT_LE(test::disagreementsOnCover(points, truePoints), 1e-3 * display.sizePx.x * display.sizePx.y);
}

INSTANTIATE_TEST_SUITE_P(Walls, EveryMethod, ::testing::ValuesIn(cases()), [](const auto& test) {
    std::string name = test.param.name();
    std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
    std::ranges::replace(name, '-', '_');
    return name;
});

}  // namespace
}  // namespace curvewall
