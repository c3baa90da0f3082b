#include "report/code_spans.h"
#include "report/document.h"
#include "report/page_files.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

namespace curvewall {
namespace {

// Longer ones wrap.
constexpr size_t kLongCell = 48;
constexpr size_t kFewPictures = 2;

pugi::xml_node append(pugi::xml_node parent, const char* name, const char* className = nullptr) {
    pugi::xml_node node = parent.append_child(name);
    if (className) node.append_attribute("class") = className;
    return node;
}

void appendText(pugi::xml_node parent, const std::string& text) {
    for (const auto& [span, isCode] : codeSpans(text)) {
        pugi::xml_node target = isCode ? parent.append_child("code") : parent;
        target.append_child(pugi::node_pcdata).set_value(std::string(span).c_str());
    }
}

std::string plainText(const std::string& text) {
    std::string plain;
    for (const auto& [span, isCode] : codeSpans(text)) plain += span;
    return plain;
}

std::string dataUri(const std::string& folder, const std::string& file) {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || bytes.empty())
        throw std::runtime_error(path.string() + ": a picture of the report cannot be read" +
                                 (errno ? std::string(": ") + std::strerror(errno) : ""));
    return "data:image/png;base64," + OIIO::Strutil::base64_encode(bytes);
}

bool isNumber(const std::string& cell) {
    return cell.find_first_of("0123456789") != std::string::npos &&
           (std::isdigit(static_cast<unsigned char>(cell[0])) || cell[0] == '-');
}

class HtmlWriter {
public:
    HtmlWriter(pugi::xml_node main, pugi::xml_node contents, const std::string& folder)
        : main_(main), contents_(contents), folder_(folder) {}

    void operator()(const Heading& heading) {
        const std::string id = anchorOf(heading.text);
        pugi::xml_node node = append(main_, fmt::format("h{}", heading.level).c_str());
        node.append_attribute("id") = id.c_str();
        appendText(node, heading.text);
        if (heading.level > 3) return;
        pugi::xml_node list = contents_;
        if (heading.level == 3 && contents_.last_child()) {
            const pugi::xml_node item = contents_.last_child();
            list = item.child("ul") ? item.child("ul") : append(item, "ul");
        }
        pugi::xml_node link = append(append(list, "li"), "a");
        link.append_attribute("href") = ("#" + id).c_str();
        appendText(link, heading.text);
    }

    void operator()(const Paragraph& paragraph) { appendText(append(main_, "p"), paragraph.text); }

    void operator()(const List& list) {
        if (list.items.empty()) return;
        pugi::xml_node node = append(main_, "ul");
        for (const std::string& item : list.items) appendText(append(node, "li"), item);
    }

    void operator()(const Table& table) {
        // With the keyboard, too, one gets to what lies beyond the border.
        pugi::xml_node box = append(main_, "div", "scroll");
        box.append_attribute("tabindex") = "0";
        pugi::xml_node node = append(box, "table");
        pugi::xml_node head = append(append(node, "thead"), "tr");
        for (size_t i = 0; i < table.columns.size(); ++i) {
            pugi::xml_node cell = append(head, "th", isNumeric(table, i) ? "number" : nullptr);
            cell.append_attribute("scope") = "col";
            appendText(cell, table.columns[i]);
        }
        pugi::xml_node body = append(node, "tbody");
        for (size_t i = 0; i < table.rows.size(); ++i) {
            const bool isBest = std::ranges::count(table.emphasized, i) > 0;
            pugi::xml_node row = append(body, "tr", isBest ? "best" : nullptr);
            for (size_t column = 0; column < table.rows[i].size(); ++column)
                appendCell(row, table.rows[i][column], isNumeric(table, column));
        }
    }

    void operator()(const PictureRow& row) {
        if (row.pictures.empty()) return;
        pugi::xml_node box =
            append(main_, "div", row.pictures.size() <= kFewPictures ? "pictures few" : "pictures");
        for (const Picture& picture : row.pictures) {
            pugi::xml_node figure = append(box, "figure");
            pugi::xml_node image = append(figure, "img");
            image.append_attribute("src") = dataUri(folder_, picture.file).c_str();
            image.append_attribute("alt") = plainText(picture.caption).c_str();
            image.append_attribute("loading") = "lazy";
            if (!picture.caption.empty()) appendText(append(figure, "figcaption"), picture.caption);
        }
    }

    // Plots that follow each other share a box.
    void operator()(const PlotFigure& plot) {
        const pugi::xml_node last = main_.last_child();
        const bool hasBox = std::string_view(last.attribute("class").value()) == "plots";
        pugi::xml_node figure = append(hasBox ? last : append(main_, "div", "plots"), "figure");
        pugi::xml_document svg;
        svg.load_string(svgOf(plot.plot, fmt::format("plot{}-", ++plots_)).c_str(),
                        pugi::parse_default | pugi::parse_ws_pcdata_single);
        figure.append_copy(svg.child("svg"));
        if (!plot.picture.caption.empty()) appendText(append(figure, "figcaption"), plot.picture.caption);
    }

private:
    static bool isBlank(const std::string& cell) { return cell.empty() || cell == "–" || cell == "∞"; }

    static bool isNumeric(const Table& table, size_t column) {
        const auto is = [column](bool (*test)(const std::string&)) {
            return [column, test](const auto& row) { return test(row[column]); };
        };
        return std::ranges::any_of(table.rows, is(isNumber)) &&
               std::ranges::all_of(table.rows,
                                   [&](const auto& row) { return is(isNumber)(row) || is(isBlank)(row); });
    }

    static void appendCell(pugi::xml_node row, const std::string& text, bool inNumbers) {
        const bool isLong = text.size() > kLongCell;
        pugi::xml_node cell = append(row, "td", isLong ? "long" : inNumbers ? "number" : nullptr);
        // A browser would take an element written as empty for one that was only opened.
        appendText(cell, text.empty() ? "–" : text);
    }

    std::string anchorOf(const std::string& text) {
        std::string anchor;
        for (const char c : plainText(text)) {
            if (std::isalnum(static_cast<unsigned char>(c)))
                anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            else if (!anchor.empty() && anchor.back() != '-')
                anchor += '-';
        }
        if (anchor.empty()) anchor = "part";
        std::string unique = anchor;
        for (int i = 2; !anchors_.insert(unique).second; ++i) unique = fmt::format("{}-{}", anchor, i);
        return unique;
    }

    pugi::xml_node main_, contents_;
    const std::string& folder_;
    std::set<std::string> anchors_;
    int plots_ = 0;
};

void appendMeta(pugi::xml_node head, const char* name, const char* content) {
    pugi::xml_node meta = append(head, "meta");
    meta.append_attribute("name") = name;
    meta.append_attribute("content") = content;
}

}  // namespace

std::string htmlOf(const Document& document, const std::string& folder) {
    pugi::xml_document page;
    page.append_child(pugi::node_doctype).set_value("html");
    pugi::xml_node html = append(page, "html");
    html.append_attribute("lang") = "en";
    pugi::xml_node head = append(html, "head");
    append(head, "meta").append_attribute("charset") = "utf-8";
    appendMeta(head, "viewport", "width=device-width, initial-scale=1");
    append(head, "title").text() = plainText(document.title).c_str();
    append(head, "style").text() = kPageStyle;
    pugi::xml_node body = append(html, "body");
    pugi::xml_node nav = append(body, "nav");
    nav.append_attribute("aria-label") = "Contents";
    append(nav, "p").text() = "Contents";
    pugi::xml_node contents = append(nav, "ul");
    pugi::xml_node main = append(body, "main");
    appendText(append(main, "h1"), document.title);
    HtmlWriter writer(main, contents, folder);
    for (const Block& block : document.blocks) std::visit(writer, block);
    if (!contents.first_child()) body.remove_child(nav);
    append(body, "script").text() = kPageScript;
    std::ostringstream out;
    page.save(out, "", pugi::format_raw | pugi::format_no_declaration);
    return out.str();
}

}  // namespace curvewall
