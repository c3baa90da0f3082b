#include "renderer/names.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace curvewall {
namespace {

template <class Enum>
struct Named {
    Enum value;
    std::string_view name;
};

constexpr std::array kMethods{Named{Method::piecewise, "piecewise"}, Named{Method::imageBased, "image-based"},
                              Named{Method::reference, "reference"}};
constexpr std::array kStyles{Named{Style::textured, "textured"}, Named{Style::unlit, "unlit"}};
constexpr std::array kOutputKinds{Named{OutputKind::color, "color"}, Named{OutputKind::depth, "depth"},
                                  Named{OutputKind::coverage, "coverage"},
                                  Named{OutputKind::position, "position"}};
constexpr std::array kImageFormats{Named{ImageFormat::png, "png"}, Named{ImageFormat::jpeg, "jpeg"},
                                   Named{ImageFormat::exr, "exr"}};

template <class Enum, size_t count>
std::optional<Enum> fromName(const std::array<Named<Enum>, count>& table, std::string_view name) {
    for (const auto& entry : table)
        if (entry.name == name) return entry.value;
    return std::nullopt;
}

template <class Enum, size_t count>
std::string_view toName(const std::array<Named<Enum>, count>& table, Enum value) {
    for (const auto& entry : table)
        if (entry.value == value) return entry.name;
    assert(false && "every value has a name");
    return {};
}

template <class Enum, size_t count>
std::string allNames(const std::array<Named<Enum>, count>& table) {
    std::string names(table.front().name);
    for (size_t i = 1; i < count; ++i) {
        names += i + 1 == count ? " or " : ", ";
        names += table[i].name;
    }
    return names;
}

}  // namespace

std::optional<Method> methodFromName(std::string_view name) { return fromName(kMethods, name); }
std::optional<Style> styleFromName(std::string_view name) { return fromName(kStyles, name); }
std::optional<OutputKind> outputKindFromName(std::string_view name) { return fromName(kOutputKinds, name); }
std::optional<ImageFormat> imageFormatFromName(std::string_view name) {
    return fromName(kImageFormats, name);
}

std::string_view nameOf(Method method) { return toName(kMethods, method); }
std::string_view nameOf(Style style) { return toName(kStyles, style); }
std::string_view nameOf(OutputKind output) { return toName(kOutputKinds, output); }
std::string_view nameOf(ImageFormat format) { return toName(kImageFormats, format); }

std::string methodNames() { return allNames(kMethods); }
std::string styleNames() { return allNames(kStyles); }
std::string outputKindNames() { return allNames(kOutputKinds); }
std::string imageFormatNames() { return allNames(kImageFormats); }

}  // namespace curvewall
