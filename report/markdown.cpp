#include "report/code_spans.h"
#include "report/document.h"
#include "report/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace curvewall {
namespace {

std::string escaped(std::string_view text, std::string_view special) {
    std::string result;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) result += '\\';
        result += c == '\n' || c == '\r' ? ' ' : c;
    }
    return result;
}

std::string inlineText(std::string_view text, bool inTable = false) {
    std::string result;
    for (const auto& [span, isCode] : codeSpans(text))
        // In code a backslash is one, but for that which keeps a bar from ending a cell.
        result += isCode ? "`" + escaped(span, inTable ? "|" : "") + "`" : escaped(span, "\\`*_[]<>&|");
    return result;
}

// What would begin a heading or a list does not.
std::string lineText(std::string_view text) {
    std::string line = inlineText(text);
    const size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
    if (line.starts_with('#') || line.starts_with('-') || line.starts_with('+'))
        line.insert(0, "\\");
    else if (digits > 0 && (line.substr(digits, 2) == ". " || line.substr(digits, 2) == ") "))
        line.insert(digits, "\\");
    return line;
}

std::string linkTo(std::string_view path) {
    std::string link;
    for (const char c : path) {
        if (std::isalnum(static_cast<unsigned char>(c)) ||
            std::string_view("/-._~").find(c) != std::string_view::npos)
            link += c;
        else
            link += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return link;
}

std::string pictureText(const Picture& picture) {
    return "![" + inlineText(picture.caption) + "](" + linkTo(picture.file) + ")";
}

std::string rowText(const std::vector<std::string>& cells, bool isEmphasized) {
    std::string row = "|";
    for (const std::string& cell : cells) {
        const std::string text = inlineText(cell, true);
        row += isEmphasized && !text.empty() ? " **" + text + "** |" : " " + text + " |";
    }
    return row + "\n";
}

struct MarkdownWriter {
    std::string operator()(const Heading& heading) const {
        return std::string(static_cast<size_t>(heading.level), '#') + " " + inlineText(heading.text) + "\n";
    }
    std::string operator()(const Paragraph& paragraph) const { return lineText(paragraph.text) + "\n"; }
    std::string operator()(const List& list) const {
        std::string lines;
        for (const std::string& item : list.items) lines.append("- ").append(lineText(item)).append("\n");
        return lines;
    }
    std::string operator()(const Table& table) const {
        std::string lines = rowText(table.columns, false) + "|";
        for (size_t i = 0; i < table.columns.size(); ++i) lines += " --- |";
        lines += "\n";
        for (size_t i = 0; i < table.rows.size(); ++i)
            lines += rowText(table.rows[i], std::ranges::count(table.emphasized, i) > 0);
        return lines;
    }
    // A table keeps pictures side by side, each above its caption.
    std::string operator()(const PictureRow& row) const {
        std::string lines;
        for (size_t begin = 0; begin < row.pictures.size(); begin += kPicturesInARow) {
            const size_t end = std::min(begin + kPicturesInARow, row.pictures.size());
            std::string files = "|", captions = "|", rule = "|";
            for (size_t i = begin; i < end; ++i) {
                files += " " + pictureText(row.pictures[i]) + " |";
                captions += " " + inlineText(row.pictures[i].caption, true) + " |";
                rule += " --- |";
            }
            if (begin > 0) lines += "\n";
            lines.append(files).append("\n").append(rule).append("\n").append(captions).append("\n");
        }
        return lines;
    }
    std::string operator()(const PlotFigure& figure) const {
        return pictureText(figure.picture) + "\n\n" + lineText(figure.picture.caption) + "\n";
    }

    static constexpr size_t kPicturesInARow = 4;
};

}  // namespace

std::string markdownOf(const Document& document) {
    std::string text = "# " + inlineText(document.title) + "\n";
    for (const Block& block : document.blocks) text += "\n" + std::visit(MarkdownWriter{}, block);
    return text;
}

void writePlots(const Document& document, const std::string& folder) {
    for (const Block& block : document.blocks) {
        const auto* figure = std::get_if<PlotFigure>(&block);
        if (!figure) continue;
        const std::filesystem::path path = std::filesystem::path(folder) / figure->picture.file;
        std::error_code error;
        std::filesystem::create_directories(path.parent_path(), error);
        if (error)
            throw std::runtime_error(path.parent_path().string() + ": cannot be made: " + error.message());
        writeTextFile(path.string(), pngOf(figure->plot));
    }
}

}  // namespace curvewall
