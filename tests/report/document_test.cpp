#include "report/document.h"

#include "renderer/image_file.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/strutil.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <set>

namespace curvewall {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Documents : public ::testing::Test {
protected:
    Documents() {
        writeFrame(folder_.path("a b.png"), {{4, 4}, 3, std::vector<float>(48, 0.5f)});
        document_.title = "Speed & <error> of `piecewise`";
        const Plot plot{"time", "ms", "px", true, true, {{"piecewise", {{10, 1}, {20, 0.5}}}}};
        document_.blocks = {Heading{2, "First part"},
                            Paragraph{"`a|b` is <quick> & *clean*, ticks ` alone"},
                            Heading{3, "Same"},
                            List{{"one", "two `code`"}},
                            Table{{"method", "ms"}, {{"a|b `c|d`", "12.5"}, {"", "–"}}, {0}},
                            Heading{2, "Same"},
                            PictureRow{{{"a b.png", "a \"dome\""}, {"a b.png", "again"}}},
                            PlotFigure{plot, {"plots/time.png", "Time"}},
                            PlotFigure{plot, {"plots/again.png", "Again"}}};
    }
    pugi::xml_document page() const {
        pugi::xml_document page;
        EXPECT_TRUE(page.load_string(htmlOf(document_, folder_.path()).c_str()));
        return page;
    }
    static size_t count(const pugi::xml_document& page, const char* xpath) {
        return page.select_nodes(xpath).size();
    }

    test::TemporaryFolder folder_;
    Document document_;
};

TEST_F(Documents, HtmlIsWellFormedAndSaysWhatTheDocumentSays) {
    const pugi::xml_document html = page();
    EXPECT_STREQ(html.select_node("/html/head/title").node().text().get(), "Speed & <error> of piecewise");
    EXPECT_EQ(count(html, "//main/h1/code[.='piecewise']"), 1u);
    EXPECT_EQ(std::string(html.select_node("//main/p").node().child("code").text().get()), "a|b");
    EXPECT_THAT(std::string(html.select_node("//main/p").node().last_child().value()),
                " is <quick> & *clean*, ticks ` alone");
    EXPECT_EQ(count(html, "//main/ul/li"), 2u);
    EXPECT_EQ(count(html, "//main//tbody/tr"), 2u);
    EXPECT_EQ(count(html, "//main//tbody/tr[@class='best']"), 1u);
    EXPECT_EQ(count(html, "//figure//*[local-name()='svg']"), 2u);
}

TEST_F(Documents, HtmlListsItsContents) {
    const pugi::xml_document html = page();
    std::vector<std::string> links;
    for (const pugi::xpath_node& link : html.select_nodes("//nav//a")) {
        links.emplace_back(link.node().attribute("href").value());
        EXPECT_EQ(count(html, ("//main/*[@id='" + links.back().substr(1) + "']").c_str()), 1u);
    }
    EXPECT_THAT(links, ::testing::ElementsAre("#first-part", "#same", "#same-2"));
    EXPECT_EQ(count(html, "//nav/ul/li/ul/li"), 1u);
}

TEST_F(Documents, HtmlNeedsNothingBesideIt) {
    const pugi::xml_document html = page();
    for (const pugi::xpath_node& found : html.select_nodes("//@*")) {
        const std::string name = found.attribute().name(), value = found.attribute().value();
        if (name == "src") {
            EXPECT_TRUE(value.starts_with("data:image/png;base64,")) << value.substr(0, 40);
        } else if (name == "href" || name == "xlink:href") {
            EXPECT_TRUE(value.starts_with('#')) << value;
        } else if (!name.starts_with("xmlns")) {
            EXPECT_THAT(value, Not(HasSubstr("//")));
        }
    }
    EXPECT_EQ(count(html, "//link | //iframe | //object | //script[@src]"), 0u);
    const std::string style = html.select_node("//style").node().text().get();
    EXPECT_THAT(style, Not(HasSubstr("url(")));
    EXPECT_THAT(style, Not(HasSubstr("@import")));
}

TEST_F(Documents, HtmlHasThePicturesThemselves) {
    const pugi::xml_document html = page();
    const pugi::xml_node image = html.select_node("//img").node();
    EXPECT_STREQ(image.attribute("alt").value(), "a \"dome\"");
    std::ifstream file(folder_.path("a b.png"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(image.attribute("src").value(), "data:image/png;base64," + OIIO::Strutil::base64_encode(bytes));
}

TEST_F(Documents, IdsOfThePageAreUnique) {
    const pugi::xml_document html = page();
    std::set<std::string> ids;
    for (const pugi::xpath_node& found : html.select_nodes("//@id"))
        EXPECT_TRUE(ids.insert(found.attribute().value()).second) << found.attribute().value();
    for (const pugi::xpath_node& use : html.select_nodes("//use/@xlink:href"))
        EXPECT_TRUE(ids.contains(use.attribute().value() + 1)) << use.attribute().value();
}

// A browser reads <td/> as the beginning of a cell, and <script/> as that of a script.
TEST_F(Documents, HtmlElementsAreEndedAsBrowsersWantIt) {
    const pugi::xml_document html = page();
    const std::set<std::string> voids{"meta", "img"};
    for (const pugi::xpath_node& found : html.select_nodes("//*[not(node())][not(ancestor-or-self::svg)]"))
        EXPECT_TRUE(voids.contains(found.node().name())) << found.node().name();
}

TEST_F(Documents, TheSameDocumentGivesTheSamePage) {
    EXPECT_EQ(htmlOf(document_, folder_.path()), htmlOf(document_, folder_.path()));
}

TEST_F(Documents, PicturesThatAreMissingAreNamed) {
    document_.blocks = {PictureRow{{{"nowhere.png", ""}}}};
    try {
        htmlOf(document_, folder_.path());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("nowhere.png"));
    }
}

TEST_F(Documents, PlotsAreWrittenIntoFoldersThatAreMade) {
    writePlots(document_, folder_.path());
    EXPECT_GT(readFrame(folder_.path("plots/time.png")).sizePx.x, 100);
    EXPECT_GT(readFrame(folder_.path("plots/again.png")).sizePx.x, 100);
}

TEST_F(Documents, MarkdownIsPlain) {
    const std::string text = markdownOf(document_);
    EXPECT_TRUE(text.starts_with("# Speed \\& \\<error\\> of `piecewise`\n\n## First part\n\n")) << text;
    EXPECT_THAT(text, HasSubstr("\n`a|b` is \\<quick\\> \\& \\*clean\\*, ticks \\` alone\n"));
    EXPECT_THAT(text, HasSubstr("\n- one\n- two `code`\n"));
    EXPECT_THAT(text, HasSubstr("![Time](plots/time.png)\n\nTime\n"));
    EXPECT_THAT(text, HasSubstr("![a \"dome\"](a%20b.png)"));
}

TEST_F(Documents, MarkdownTablesKeepTheirColumns) {
    const std::string text = markdownOf(document_);
    EXPECT_THAT(text, HasSubstr("\n| method | ms |\n| --- | --- |\n"
                                "| **a\\|b `c\\|d`** | **12.5** |\n|  | – |\n"));
}

TEST(Markdown, LinesThatWouldBeginSomethingElseDoNot) {
    for (const char* text : {"# one", "- one", "+ one"})
        EXPECT_EQ(markdownOf({"t", {Paragraph{text}}}), std::string("# t\n\n\\") + text + "\n");
    EXPECT_EQ(markdownOf({"t", {Paragraph{"12. one\ntwo"}}}), "# t\n\n12\\. one two\n");
    EXPECT_EQ(markdownOf({"t", {Paragraph{"12.5 px"}}}), "# t\n\n12.5 px\n");
}

TEST(Html, OfHardlyAnythingIsAPage) {
    pugi::xml_document page;
    ASSERT_TRUE(page.load_string(htmlOf({"t", {List{}, PictureRow{}}}, "").c_str()));
    EXPECT_TRUE(page.select_nodes("//nav | //ul").empty());
}

}  // namespace
}  // namespace curvewall
