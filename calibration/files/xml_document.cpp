#include "calibration/files/xml_document.h"

#include <algorithm>
#include <iterator>
#include <pugixml.hpp>
#include <utility>

namespace curvewall {
namespace {

constexpr size_t kMostBytes = size_t{32} << 20;
constexpr size_t kMostParts = 1'000'000;
constexpr int kMostLevels = 64;

constexpr std::string_view kWhiteSpace = " \t\r\n";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool isNamed(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, lower, lower);
}

// The element that follows in the order of the file, within `top`.
pugi::xml_node nextWithin(pugi::xml_node top, pugi::xml_node node) {
    if (node.first_child()) return node.first_child();
    while (node != top && !node.next_sibling()) node = node.parent();
    return node == top ? pugi::xml_node() : node.next_sibling();
}

// A walk without recursion: nothing is known yet of how deep the tree is.
void requireBounds(const pugi::xml_document& document, const std::string& path) {
    size_t parts = 0;
    int level = 1;
    for (pugi::xml_node node = document.first_child(); node;) {
        if (node.type() == pugi::node_doctype)
            throw InputError(path, "", "XML without a document type (DOCTYPE), which may name other files",
                             "one");
        parts += 1 + static_cast<size_t>(std::distance(node.attributes_begin(), node.attributes_end()));
        if (parts > kMostParts)
            throw InputError(path, "",
                             "XML of at most " + std::to_string(kMostParts) + " elements and attributes",
                             "more");
        if (level > kMostLevels && node.type() == pugi::node_element)
            throw InputError(path, "", "XML of at most " + std::to_string(kMostLevels) + " levels", "more");
        if (node.first_child()) {
            ++level;
            node = node.first_child();
            continue;
        }
        while (node && !node.next_sibling()) {
            node = node.parent();
            --level;
        }
        node = node.next_sibling();
    }
}

}  // namespace

struct XmlElement::Document {
    std::string path;
    pugi::xml_document tree;
};

XmlElement parseXml(const FileBytes& file) {
    if (file.bytes.size() > kMostBytes)
        throw InputError(file.path, "", "XML of at most " + std::to_string(kMostBytes) + " bytes",
                         std::to_string(file.bytes.size()));
    auto document = std::make_shared<XmlElement::Document>();
    document->path = file.path;
    const pugi::xml_parse_result result = document->tree.load_buffer(
        file.bytes.data(), file.bytes.size(), pugi::parse_default | pugi::parse_doctype);
    if (!result)
        throw InputError(file.path, "byte " + std::to_string(result.offset), "XML", result.description());
    requireBounds(document->tree, file.path);
    const pugi::xml_node root = document->tree.document_element();
    if (!root) throw InputError(file.path, "", "XML", "no element");
    return {std::move(document), root.internal_object()};
}

bool looksLikeXml(std::string_view bytes) {
    if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
    const size_t begin = bytes.find_first_not_of(kWhiteSpace);
    return begin != std::string_view::npos && bytes[begin] == '<';
}

std::string xmlRootName(std::string_view bytes) {
    constexpr std::string_view kEndOfName = " \t\r\n/>";
    if (!looksLikeXml(bytes)) return "";
    for (size_t at = bytes.find('<'); at != std::string_view::npos; at = bytes.find('<', at)) {
        const std::string_view rest = bytes.substr(at);
        if (rest.starts_with("<!--")) {
            at = bytes.find("-->", at);
        } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
            at = bytes.find('>', at);
        } else {
            return std::string(rest.substr(1, rest.find_first_of(kEndOfName) - 1));
        }
        if (at == std::string_view::npos) break;
    }
    return "";
}

const std::string& XmlElement::path() const { return document_->path; }

std::string XmlElement::name() const { return pugi::xml_node(node_).name(); }

std::string XmlElement::place() const {
    std::string place;
    for (pugi::xml_node node(node_); node.type() == pugi::node_element; node = node.parent()) {
        size_t before = 0, after = 0;
        for (auto other = node.previous_sibling(); other; other = other.previous_sibling())
            before += isNamed(other.name(), node.name());
        for (auto other = node.next_sibling(); other; other = other.next_sibling())
            after += isNamed(other.name(), node.name());
        std::string step = node.name();
        if (before + after > 0) step += "[" + std::to_string(before) + "]";
        if (!place.empty()) step += "/";
        place.insert(0, step);
    }
    return place;
}

InputError XmlElement::error(const std::string& expected, const std::string& found) const {
    return {path(), place(), expected, found};
}

std::optional<XmlElement> XmlElement::child(std::string_view name) const {
    for (const pugi::xml_node node : pugi::xml_node(node_).children())
        if (node.type() == pugi::node_element && isNamed(node.name(), name))
            return XmlElement(document_, node.internal_object());
    return std::nullopt;
}

std::vector<XmlElement> XmlElement::children(std::string_view name) const {
    std::vector<XmlElement> found = children();
    std::erase_if(found, [name](const XmlElement& element) { return !isNamed(element.name(), name); });
    return found;
}

std::vector<XmlElement> XmlElement::children() const {
    std::vector<XmlElement> found;
    for (const pugi::xml_node node : pugi::xml_node(node_).children())
        if (node.type() == pugi::node_element) found.push_back({document_, node.internal_object()});
    return found;
}

std::vector<XmlElement> XmlElement::descendants(std::string_view name) const {
    std::vector<XmlElement> found;
    const pugi::xml_node top(node_);
    for (pugi::xml_node node = nextWithin(top, top); node; node = nextWithin(top, node))
        if (node.type() == pugi::node_element && isNamed(node.name(), name))
            found.push_back({document_, node.internal_object()});
    return found;
}

std::string XmlElement::text() const {
    std::string text;
    for (const pugi::xml_node node : pugi::xml_node(node_).children())
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) text += node.value();
    return std::string(trimmed(text));
}

std::optional<std::string> XmlElement::attribute(std::string_view name) const {
    for (const pugi::xml_attribute attribute : pugi::xml_node(node_).attributes())
        if (isNamed(attribute.name(), name)) return std::string(trimmed(attribute.value()));
    return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> XmlElement::attributes() const {
    std::vector<std::pair<std::string, std::string>> attributes;
    for (const pugi::xml_attribute attribute : pugi::xml_node(node_).attributes())
        attributes.emplace_back(attribute.name(), trimmed(attribute.value()));
    return attributes;
}

double XmlElement::number() const {
    const auto number = finiteNumberFrom(text());
    if (!number) throw error("a finite number", "\"" + text() + "\"");
    return *number;
}

std::optional<double> XmlElement::childNumber(std::string_view name) const {
    const auto element = child(name);
    if (!element || element->text().empty()) return std::nullopt;
    return element->number();
}

std::optional<double> XmlElement::attributeNumber(std::string_view name) const {
    const auto value = attribute(name);
    if (!value) return std::nullopt;
    const auto number = finiteNumberFrom(*value);
    if (!number)
        throw InputError(path(), place() + "/@" + std::string(name), "a finite number", "\"" + *value + "\"");
    return number;
}

}  // namespace curvewall
