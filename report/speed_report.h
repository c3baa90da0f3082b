#pragma once
// What `curvewall report` measured: methods with their knobs turned, on displays and in scenes.

#include "report/errors.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace curvewall {

// Of one number over the rounds of a measurement.
struct Spread {
    double median = 0, min = 0, max = 0;
};

// One method with its knobs set.
struct SettingName {
    std::string method;   // "image-based"
    std::string variant;  // "cube, linear"; empty where there is but one
    std::string knob;     // "face_size_px"; empty where nothing turns
    double value = 0;     // of the knob
    int samples = 1;

    std::string curve() const { return variant.empty() ? method : method + ", " + variant; }
    // With the knob: "image-based, cube, linear, 1024 px".
    std::string text() const;
};

// In a closed room around the eye, where every pixel with a ray shows one surface.
struct RoomCoverage {
    uint64_t uncoveredPixels = 0;
    uint64_t twiceCoveredPixels = 0;
};

struct SettingResult {
    SettingName setting;
    std::string refusal;  // why it cannot be drawn; empty where it can, and only then the rest is there
    MethodErrors errors{};
    // At pixel centres, with the scene in flat colours: of edges alone, whatever filters textures. Of one
    // sample a pixel.
    std::optional<ImageDifference> edges{};
    RoomCoverage room{};
    Spread frameMs{};        // of the medians of the rounds
    nlohmann::json stats{};  // as docs/command-line.md has them: pieces, pairs, stages, overdraw, memory
    // PNG files relative to the report's folder, of settings that stand for their method: the whole picture,
    // what matters most of it, and the geometric error by pixel.
    std::string picture, crop, errorMap;
};

// Pixels that are not covered as they should be: in the scene those that show nothing for something or
// something for nothing, in the closed room those that show nothing or the room twice.
uint64_t coverageFaults(const SettingResult& result);

// A curve's error against its knob: error ~ knob^order, by least squares over what lies above the floor.
struct ErrorOrder {
    std::string curve, error;
    double order = 0, expected = 0;
    int points = 0;
};

struct TruthFacts {
    int supersamples = 0;
    double noiseDb = 0;  // PSNR of the supersampled truth against what it would be with endless rays
    std::string picture, crop;
};

// What stays wrong where the projection is exact: of plain perspective pictures as dense as the display, with
// the same samples and filter.
struct SamplingFloor {
    int samples = 1;
    double shareOff = 0;
    double edgesOff = 0;  // in flat colours
    double psnrDb = 0;
    double supersampledPsnrDb = 0;
};

// One display with one scene.
struct ViewReport {
    std::string wall, display, scene;
    glm::ivec2 sizePx{0};
    std::string projection;
    TruthFacts truth;
    std::vector<SamplingFloor> floors;
    std::vector<SettingResult> settings;
};

struct SpeedReport {
    std::string glRenderer, processor;
    double tolerancePx = 0;
    std::vector<ViewReport> views;
};

}  // namespace curvewall
