#include "renderer/names.h"

#include <cassert>
#include <cstddef>

namespace curvewall {
namespace {

template <class Enum>
struct Named {
    Enum value;
    std::string_view name;
};

constexpr Named<Method> kMethods[] = {{Method::piecewise, "piecewise"},
                                      {Method::imageBased, "image-based"},
                                      {Method::boundedRaycast, "bounded-raycast"},
                                      {Method::vertexWarp, "vertex-warp"},
                                      {Method::reference, "reference"},
                                      {Method::automatic, "auto"}};
constexpr Named<Engine> kEngines[] = {{Engine::compute, "compute"},
                                      {Engine::geometry, "geometry"},
                                      {Engine::tessellation, "tessellation"},
                                      {Engine::loop, "loop"}};
constexpr Named<SourceKind> kSources[] = {
    {SourceKind::cube, "cube"}, {SourceKind::hemicube, "hemicube"}, {SourceKind::planar, "planar"}};
constexpr Named<SourceFilter> kFilters[] = {{SourceFilter::nearest, "nearest"},
                                            {SourceFilter::linear, "linear"},
                                            {SourceFilter::bicubic, "bicubic"},
                                            {SourceFilter::mipmap, "mipmap"},
                                            {SourceFilter::anisotropic, "anisotropic"}};
constexpr Named<FacePass> kFacePasses[] = {{FacePass::separate, "separate"}, {FacePass::layered, "layered"}};
constexpr Named<SourceLookup> kLookups[] = {{SourceLookup::pixel, "pixel"}, {SourceLookup::mesh, "mesh"}};
constexpr Named<BoundingShape> kBoundingShapes[] = {{BoundingShape::triangle, "triangle"},
                                                    {BoundingShape::quad, "quad"},
                                                    {BoundingShape::genericQuad, "generic-quad"}};
constexpr Named<Style> kStyles[] = {{Style::textured, "textured"},
                                    {Style::unlit, "unlit"},
                                    {Style::wireframe, "wireframe"},
                                    {Style::penAndInk, "pen-and-ink"}};
constexpr Named<OutputKind> kOutputKinds[] = {{OutputKind::color, "color"},
                                              {OutputKind::depth, "depth"},
                                              {OutputKind::coverage, "coverage"},
                                              {OutputKind::position, "position"}};
constexpr Named<ImageFormat> kImageFormats[] = {
    {ImageFormat::png, "png"}, {ImageFormat::jpeg, "jpeg"}, {ImageFormat::exr, "exr"}};

template <class Enum, size_t count>
std::optional<Enum> fromName(const Named<Enum> (&table)[count], std::string_view name) {
    for (const auto& entry : table)
        if (entry.name == name) return entry.value;
    return std::nullopt;
}

template <class Enum, size_t count>
std::string_view toName(const Named<Enum> (&table)[count], Enum value) {
    for (const auto& entry : table)
        if (entry.value == value) return entry.name;
    assert(false && "every value has a name");
    return {};
}

template <class Enum, size_t count>
std::string allNames(const Named<Enum> (&table)[count]) {
    std::string names(table[0].name);
    for (size_t i = 1; i < count; ++i) {
        names += i + 1 == count ? " or " : ", ";
        names += table[i].name;
    }
    return names;
}

}  // namespace

std::optional<Method> methodFromName(std::string_view name) { return fromName(kMethods, name); }
std::optional<Engine> engineFromName(std::string_view name) { return fromName(kEngines, name); }
std::optional<SourceKind> sourceFromName(std::string_view name) { return fromName(kSources, name); }
std::optional<SourceFilter> filterFromName(std::string_view name) { return fromName(kFilters, name); }
std::optional<FacePass> facePassFromName(std::string_view name) { return fromName(kFacePasses, name); }
std::optional<SourceLookup> lookupFromName(std::string_view name) { return fromName(kLookups, name); }
std::optional<BoundingShape> boundsFromName(std::string_view name) { return fromName(kBoundingShapes, name); }
std::optional<Style> styleFromName(std::string_view name) { return fromName(kStyles, name); }
std::optional<OutputKind> outputKindFromName(std::string_view name) { return fromName(kOutputKinds, name); }
std::optional<ImageFormat> imageFormatFromName(std::string_view name) {
    return fromName(kImageFormats, name);
}

std::string_view nameOf(Method method) { return toName(kMethods, method); }
std::string_view nameOf(Engine engine) { return toName(kEngines, engine); }
std::string_view nameOf(SourceKind source) { return toName(kSources, source); }
std::string_view nameOf(SourceFilter filter) { return toName(kFilters, filter); }
std::string_view nameOf(FacePass pass) { return toName(kFacePasses, pass); }
std::string_view nameOf(SourceLookup lookup) { return toName(kLookups, lookup); }
std::string_view nameOf(BoundingShape bounds) { return toName(kBoundingShapes, bounds); }
std::string_view nameOf(Style style) { return toName(kStyles, style); }
std::string_view nameOf(OutputKind output) { return toName(kOutputKinds, output); }
std::string_view nameOf(ImageFormat format) { return toName(kImageFormats, format); }

std::string methodNames() { return allNames(kMethods); }
std::string engineNames() { return allNames(kEngines); }
std::string sourceNames() { return allNames(kSources); }
std::string filterNames() { return allNames(kFilters); }
std::string facePassNames() { return allNames(kFacePasses); }
std::string lookupNames() { return allNames(kLookups); }
std::string boundsNames() { return allNames(kBoundingShapes); }
std::string styleNames() { return allNames(kStyles); }
std::string outputKindNames() { return allNames(kOutputKinds); }
std::string imageFormatNames() { return allNames(kImageFormats); }

}  // namespace curvewall
