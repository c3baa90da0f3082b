#include "calibration/files/xml_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

XmlElement parse(const std::string& text) { return parseXml({"wall.xml", text}); }

std::string complaint(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no complaint";
}

std::string repeated(const std::string& text, size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (size_t i = 0; i < count; ++i) all += text;
    return all;
}

TEST(XmlDocument, NamesAreFoundInAnyLetterCase) {
    const XmlElement root =
        parse("<MPCDI Version='2.0'><Display><buffer xResolution=' 512 '/></Display></MPCDI>");
    EXPECT_EQ(root.attribute("VERSION"), "2.0");
    EXPECT_EQ(root.child("display")->child("BUFFER")->attributeNumber("xresolution"), 512);
    EXPECT_FALSE(root.child("buffer"));
    EXPECT_FALSE(root.attribute("level"));
}

TEST(XmlDocument, AByteOrderMarkIsNoPartOfIt) {
    EXPECT_EQ(parse("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\n<a>x</a>").text(), "x");
}

TEST(XmlDocument, PlacesCountElementsOfOneName) {
    const XmlElement root = parse("<r><a/><b><c/></b><a/><b><c>1,5</c></b></r>");
    const auto found = root.descendants("c");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].place(), "r/b[1]/c");
    EXPECT_EQ(complaint([&] { static_cast<void>(found[1].number()); }),
              "wall.xml: r/b[1]/c: expected a finite number, found \"1,5\"");
}

TEST(XmlDocument, DescendantsComeInTheOrderOfTheFile) {
    const XmlElement root = parse("<r><x n='1'><x n='2'/></x><y><x n='3'/></y></r>");
    std::string order;
    for (const XmlElement& x : root.descendants("X")) order += *x.attribute("n");
    EXPECT_EQ(order, "123");
    EXPECT_TRUE(root.child("y")->child("x")->descendants("x").empty());
}

TEST(XmlDocument, EmptyElementsHaveNoNumber) {
    const XmlElement root = parse("<r><a></a><b> </b><c>+2.5e1</c></r>");
    EXPECT_FALSE(root.childNumber("a"));
    EXPECT_FALSE(root.childNumber("b"));
    EXPECT_FALSE(root.childNumber("d"));
    EXPECT_EQ(root.childNumber("c"), 25);
}

TEST(XmlDocument, ExternalEntitiesAreRefusedUnread) {
    EXPECT_THAT(
        complaint([] { parse("<!DOCTYPE r [<!ENTITY x SYSTEM 'file:///etc/hostname'>]><r>&x;</r>"); }),
        HasSubstr("wall.xml: expected XML without a document type (DOCTYPE)"));
}

TEST(XmlDocument, AnEntityThatNobodyDeclaredStaysText) { EXPECT_EQ(parse("<r>&x;</r>").text(), "&x;"); }

TEST(XmlDocument, DeepNestingIsRefusedWithoutRecursion) {
    const auto nested = [](size_t levels) { return repeated("<a>", levels) + repeated("</a>", levels); };
    EXPECT_NO_THROW(parse(nested(64)));
    EXPECT_THAT(complaint([&] { parse(nested(65)); }), HasSubstr("at most 64 levels"));
    EXPECT_THAT(complaint([&] { parse(nested(1'000'000)); }), HasSubstr("at most"));
    EXPECT_THAT(complaint([&] { parse(repeated("<a>", 100'000)); }), HasSubstr("expected XML"));
}

TEST(XmlDocument, SizeAndNumberOfPartsAreLimited) {
    EXPECT_THAT(complaint([] { parse("<r>" + repeated("<a/>", 1'000'000) + "</r>"); }),
                HasSubstr("elements and attributes"));
    EXPECT_THAT(complaint([] { parse("<r>" + std::string(33 << 20, ' ') + "</r>"); }), HasSubstr("bytes"));
}

TEST(XmlDocument, DamagedXmlIsRefusedWithThePlace) {
    EXPECT_THAT(complaint([] { parse("<r><a></r>"); }), HasSubstr("wall.xml: byte "));
    EXPECT_THAT(complaint([] { parse(""); }), HasSubstr("expected XML"));
    EXPECT_THAT(complaint([] { parse("<?xml version='1.0'?>"); }), HasSubstr("expected XML"));
    EXPECT_THAT(complaint([] { parse(std::string("<r a='\0", 7)); }), HasSubstr("expected XML"));
}

TEST(XmlDocument, AnElementKeepsItsDocument) {
    const auto child = parse("<r><a>kept</a></r>").child("a");
    EXPECT_EQ(child->text(), "kept");
    EXPECT_EQ(child->path(), "wall.xml");
}

}  // namespace
}  // namespace curvewall
