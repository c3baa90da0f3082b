#pragma once
// The words that the command line and the network use for methods, engines, sources and how they are
// drawn, looked up and filtered, bounding shapes, styles, outputs and image formats.

#include "renderer/image_file.h"
#include "renderer/look.h"
#include "renderer/render.h"

#include <optional>
#include <string>
#include <string_view>

namespace curvewall {

// Nothing when no such thing has that name.
std::optional<Method> methodFromName(std::string_view name);
std::optional<Engine> engineFromName(std::string_view name);
std::optional<SourceKind> sourceFromName(std::string_view name);
std::optional<SourceFilter> filterFromName(std::string_view name);
std::optional<FacePass> facePassFromName(std::string_view name);
std::optional<SourceLookup> lookupFromName(std::string_view name);
std::optional<BoundingShape> boundsFromName(std::string_view name);
std::optional<Style> styleFromName(std::string_view name);
std::optional<OutputKind> outputKindFromName(std::string_view name);
std::optional<ImageFormat> imageFormatFromName(std::string_view name);

std::string_view nameOf(Method method);
std::string_view nameOf(Engine engine);
std::string_view nameOf(SourceKind source);
std::string_view nameOf(SourceFilter filter);
std::string_view nameOf(FacePass pass);
std::string_view nameOf(SourceLookup lookup);
std::string_view nameOf(BoundingShape bounds);
std::string_view nameOf(Style style);
std::string_view nameOf(OutputKind output);
std::string_view nameOf(ImageFormat format);

// Every name, for messages: "color, depth, coverage or position".
std::string methodNames();
std::string engineNames();
std::string sourceNames();
std::string filterNames();
std::string facePassNames();
std::string lookupNames();
std::string boundsNames();
std::string styleNames();
std::string outputKindNames();
std::string imageFormatNames();

}  // namespace curvewall
