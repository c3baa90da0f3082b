#include "server/render_api.h"

#include "calibration/errors.h"
#include "calibration/files/json_fields.h"
#include "calibration/readers/projection_fields.h"
#include "renderer/names.h"
#include "renderer/request_limits.h"

#include <glm/trigonometric.hpp>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

namespace curvewall {
namespace {

constexpr Range kPositionM{-1e12, 1e12};
constexpr Range kAngleDeg{-1e6, 1e6};
constexpr Range kTessellationPx{0, kMostTessellationPx};
constexpr Range kTolerancePx{kLeastTolerancePx, kMostTolerancePx};

UsageError impossible(const std::string& field, const std::string& expected, const std::string& found) {
    return UsageError(field + ": expected " + expected + ", found " + found);
}

template <class Enum>
void readName(JsonFields& fields, const char* key, std::optional<Enum> (*fromName)(std::string_view),
              std::string (*allNames)(), Enum& value) {
    const std::optional<std::string> name = fields.text(key);
    if (!name) return;
    const std::optional<Enum> known = fromName(*name);
    if (!known) throw impossible(key, allNames(), describe(*name));
    value = *known;
}

Camera decodeCamera(JsonFields fields) {
    fields.require("position");
    const auto position = *fields.numbers("position", 3, kPositionM);
    const auto angleRad = [&fields](const char* key) {
        return glm::radians(fields.number(key, kAngleDeg).value_or(0));
    };
    Camera camera;
    camera.positionM = {position[0], position[1], position[2]};
    camera.orientation = {angleRad("yaw_deg"), angleRad("pitch_deg"), angleRad("roll_deg")};
    fields.refuseUnknownKeys();
    return camera;
}

void decodeFormat(JsonFields& fields, RenderCall& call) {
    const bool isColor = call.request.output == OutputKind::color;
    call.format = isColor ? ImageFormat::png : ImageFormat::exr;
    readName(fields, "format", imageFormatFromName, imageFormatNames, call.format);
    if (!isColor && call.format != ImageFormat::exr)
        throw impossible("format", "exr for output_kind " + std::string(nameOf(call.request.output)),
                         std::string(nameOf(call.format)));
    call.request.linearOutput = call.format == ImageFormat::exr;
}

struct Names {
    std::string wall;
    std::string scene;
};

// All that can be said of the body without knowing the walls and scenes.
Names decodeFields(JsonFields fields, RenderCall& call) {
    RenderRequest& request = call.request;
    fields.require("wall");
    fields.require("scene");
    Names names{*fields.text("wall"), *fields.text("scene")};
    const std::optional<std::string> display = fields.text("display");
    if (display && display->empty()) throw impossible("display", "a name", "an empty one");
    request.display = display.value_or("");
    if (auto camera = fields.object("camera")) {
        request.camera = decodeCamera(std::move(*camera));
        call.cameraGiven = true;
    }
    if (const auto eye = vector3(fields, "eye", kAnywhereM)) request.eyeM = *eye;
    readName(fields, "method", methodFromName, methodNames, request.method);
    readName(fields, "engine", engineFromName, engineNames, request.engine);
    request.tolerancePx = fields.number("tolerance_px", kTolerancePx).value_or(request.tolerancePx);
    if (const auto length = fields.number("tessellation_px", kTessellationPx)) {
        if (*length > 0 && *length < kLeastTessellationPx)
            throw impossible("tessellation_px", "0 or at least " + describe(kLeastTessellationPx),
                             describe(*length));
        request.tessellationPx = *length;
    }
    readName(fields, "source", sourceFromName, sourceNames, request.source);
    readName(fields, "filter", filterFromName, filterNames, request.filter);
    readName(fields, "faces", facePassFromName, facePassNames, request.facePass);
    readName(fields, "lookup", lookupFromName, lookupNames, request.lookup);
    if (const auto step = fields.wholeNumber("mesh_step_px", kLeastMeshStepPx, kMostMeshStepPx))
        request.meshStepPx = static_cast<int>(*step);
    if (const auto size = fields.wholeNumber("face_size", 0, kMostFacePx)) {
        if (*size != 0 && *size < kLeastFacePx)
            throw impossible("face_size", "0 or at least " + std::to_string(kLeastFacePx),
                             std::to_string(*size));
        request.faceSizePx = static_cast<int>(*size);
    }
    readName(fields, "bounds", boundsFromName, boundsNames, request.bounds);
    request.samples = static_cast<int>(fields.wholeNumber("samples", 1, kMostSamples).value_or(1));
    if (const auto anisotropy = fields.wholeNumber("anisotropy", 1, kMostAnisotropy))
        request.anisotropy = static_cast<int>(*anisotropy);
    readName(fields, "style", styleFromName, styleNames, request.style);
    readName(fields, "output_kind", outputKindFromName, outputKindNames, request.output);
    decodeFormat(fields, call);
    fields.refuseUnknownKeys();
    return names;
}

// Texels of the image-based method's pictures, at most: which size the display asks for is not known before
// its rays are.
uint64_t mostTexels(const RenderRequest& request) {
    const bool isPlanar = request.source == SourceKind::planar;
    const int automaticPx = isPlanar ? kMostFacePx : kMostAutomaticFacePx;
    const auto sidePx = static_cast<uint64_t>(request.faceSizePx > 0 ? request.faceSizePx : automaticPx);
    const uint64_t faces = isPlanar ? 1 : request.source == SourceKind::hemicube ? 5 : 6;
    return faces * sidePx * sidePx;
}

void checkCost(const RenderRequest& request, const Display& display, uint64_t maxSamplesPerFrame) {
    const uint64_t pixels = static_cast<uint64_t>(display.sizePx.x) * static_cast<uint64_t>(display.sizePx.y);
    const uint64_t drawn = request.method == Method::imageBased ? mostTexels(request) : pixels;
    const uint64_t samples = drawn * static_cast<uint64_t>(request.samples);
    if (samples > maxSamplesPerFrame)
        throw impossible("samples",
                         "a frame of at most " + std::to_string(maxSamplesPerFrame) + " samples in all",
                         std::to_string(samples));
}

std::string_view mediaTypeOf(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return "image/png";
        case ImageFormat::jpeg:
            return "image/jpeg";
        case ImageFormat::exr:
            return "image/x-exr";
    }
    return {};
}

std::string serverTiming(const RenderedImage& image) {
    std::array<char, 128> text{};
    const int length =
        std::snprintf(text.data(), text.size(), "queue;dur=%.3f, render;dur=%.3f, encode;dur=%.3f",
                      image.queueTime.count(), image.renderTime.count(), image.encodeTime.count());
    return {text.data(), static_cast<size_t>(length)};
}

Answer answerFor(RenderedImage image) {
    Answer answer{200, std::string(mediaTypeOf(image.format)), {}, {}};
    answer.headers = {{"Server-Timing", serverTiming(image)},
                      {"Curvewall-Stats", std::move(image.statsJson)}};
    answer.body = std::move(image.bytes);
    return answer;
}

std::string_view explain(Refusal::Reason reason) {
    switch (reason) {
        case Refusal::Reason::full:
            return "too many renders are waiting";
        case Refusal::Reason::late:
            return "the render did not begin before its deadline";
        case Refusal::Reason::fitting:
            return "fitting the pieces of this display takes longer than the deadline";
        case Refusal::Reason::abandoned:
            return "the client closed the connection before the render began";
        case Refusal::Reason::stopping:
            return "the daemon is stopping";
    }
    return {};
}

Answer answerFor(const Refusal& refusal) {
    Answer answer = problem(503, explain(refusal.reason));
    answer.headers.emplace_back("Retry-After", std::to_string(refusal.retryAfter.count()));
    return answer;
}

Answer answerFor(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (...) {
        return answerToCurrentException();
    }
}

}  // namespace

RenderCall decodeRenderCall(std::string_view body, const Library& library, uint64_t maxSamplesPerFrame) {
    RenderCall call;
    Names names;
    try {
        const nlohmann::json root = parseJson(body);
        names = decodeFields(JsonFields(root, ""), call);
    } catch (const JsonSyntaxError& error) {
        throw MalformedRequest(std::string("the body is not usable JSON: ") + error.what());
    } catch (const FieldError& error) {
        if (error.kind == FieldError::Kind::value) throw UsageError(error.what());
        throw MalformedRequest(error.what());
    }
    call.request.wall = findWall(library, names.wall);
    call.scene = findScene(library, names.scene);
    checkCost(call.request, findDisplay(*call.request.wall, call.request.display), maxSamplesPerFrame);
    return call;
}

Answer answerTo(RenderOutcome outcome) {
    return std::visit([](auto& alternative) { return answerFor(std::move(alternative)); }, outcome);
}

Answer answerToCurrentException() {
    try {
        throw;
    } catch (const MalformedRequest& error) {
        return problem(400, error.what());
    } catch (const UsageError& error) {
        return problem(422, error.what());
    } catch (const std::exception& error) {
        spdlog::error("a render failed: {}", error.what());
        return problem(500, std::string("the render failed: ") + error.what());
    } catch (...) {
        spdlog::error("a render failed with an exception of unknown type");
        return problem(500, "the render failed");
    }
}

}  // namespace curvewall
