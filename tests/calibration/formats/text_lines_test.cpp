#include "calibration/formats/text_lines.h"

#include "calibration/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

using testing::ElementsAre;

TEST(TextLines, SkipByteOrderMarksBlanksAndBlankLinesButCountThem) {
    const FileBytes file{"a.txt", "\xEF\xBB\xBF one\t\r\n\r\n \n two"};
    TextLines lines(file);
    const auto first = lines.next(), second = lines.next();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->text, "one");
    EXPECT_EQ(first->number, 1U);
    EXPECT_EQ(second->text, "two");
    EXPECT_EQ(second->number, 4U);
    EXPECT_FALSE(lines.next());
    EXPECT_FALSE(lines.next());
}

TEST(TextLines, AFileWithoutLinesHasNone) {
    for (const char* bytes : {"", "\n", " \r\n\t"}) {
        const FileBytes file{"a.txt", bytes};
        EXPECT_FALSE(TextLines(file).next());
    }
}

TEST(TextLines, WordsAreSeparatedByAnyBlanks) {
    EXPECT_THAT(wordsOf(" a  b\tc "), ElementsAre("a", "b", "c"));
    EXPECT_THAT(wordsOf("  "), ElementsAre());
}

TEST(TextLines, FieldsMayBeEmpty) {
    EXPECT_THAT(fieldsOf("a; b;;c ;", ';'), ElementsAre("a", "b", "", "c", ""));
    EXPECT_THAT(fieldsOf("", ';'), ElementsAre(""));
}

TEST(TextLines, NumbersAreWholeTexts) {
    EXPECT_EQ(numberOf("-1.5e3"), -1500);
    EXPECT_EQ(numberOf("+2"), 2);
    EXPECT_TRUE(std::isnan(numberOf("nan").value()));
    for (const char* text : {"", "1x", "1,5", "x", "+-1", "1e999", " 1"})
        EXPECT_FALSE(numberOf(text)) << text;
    EXPECT_EQ(wholeNumberOf("12"), 12);
    for (const char* text : {"1.0", "99999999999999999999", "-"}) EXPECT_FALSE(wholeNumberOf(text)) << text;
    EXPECT_FALSE(numbersOf({"1", "2"}, 3));
    EXPECT_FALSE(numbersOf({"1", "b"}, 2));
}

TEST(TextLines, MessagesNameTheLineAndQuoteNoControlCharacters) {
    const FileBytes file{"a.txt", ""};
    try {
        refuseLine(file, {7, "\x1b[31m" + std::string(100, 'a')}, "numbers");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(),
                  "a.txt: line 7: expected numbers, found \"?[31m" + std::string(55, 'a') + "...\"");
    }
}

}  // namespace
}  // namespace curvewall
