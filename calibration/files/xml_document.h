#pragma once
// XML files as programs write them: names in any letter case, with or without a byte order mark.

#include "calibration/errors.h"
#include "calibration/files/file_bytes.h"
#include "calibration/files/number_text.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pugi {
struct xml_node_struct;
}

namespace curvewall {

// One element of a document; it keeps the document alive. Names of elements and attributes are looked up in
// whatever letter case; white space around texts and attributes is left out.
class XmlElement {
public:
    const std::string& path() const;  // of the file
    std::string name() const;

    // Where the element is, for messages: "MPCDI/display/buffer[1]/region[0]", counted among those of a name.
    std::string place() const;
    InputError error(const std::string& expected, const std::string& found) const;

    std::optional<XmlElement> child(std::string_view name) const;      // the first one of that name
    std::vector<XmlElement> children(std::string_view name) const;     // of that name
    std::vector<XmlElement> children() const;                          // all of them
    std::vector<XmlElement> descendants(std::string_view name) const;  // anywhere below, as the file has them

    std::string text() const;  // what is directly in the element, without that of its children
    std::optional<std::string> attribute(std::string_view name) const;
    std::vector<std::pair<std::string, std::string>> attributes() const;  // names as the file has them

    // Throws InputError for what is there and is no finite number.
    double number() const;
    std::optional<double> childNumber(std::string_view name) const;  // an empty element is none
    std::optional<double> attributeNumber(std::string_view name) const;

private:
    struct Document;
    friend XmlElement parseXml(const FileBytes& file);
    XmlElement(std::shared_ptr<const Document> document, pugi::xml_node_struct* node)
        : document_(std::move(document)), node_(node) {}

    std::shared_ptr<const Document> document_;
    pugi::xml_node_struct* node_;
};

// The root element. Throws InputError for what is no XML; for more than 32 MiB, a million elements and
// attributes, or 64 levels; and for a document type, which may ask for files from anywhere.
XmlElement parseXml(const FileBytes& file);

// Whether the bytes begin like XML, after a byte order mark and white space.
bool looksLikeXml(std::string_view bytes);

// The name of the root element, without parsing what follows it; empty for what is no XML in UTF-8.
std::string xmlRootName(std::string_view bytes);

}  // namespace curvewall
