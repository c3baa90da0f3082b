#pragma once
// Frames to and from image files and encoded bytes, by OpenImageIO.

#include "renderer/frame.h"
#include "renderer/look.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

enum class ImageFormat { png, jpeg, exr };

// From a file name's extension (.png, .jpg, .jpeg, .exr). Throws UsageError otherwise.
ImageFormat imageFormatFromPath(std::string_view path);

// PNG and JPEG are 8-bit sRGB and take colour only: UsageError for anything else. EXR is linear float with
// the channels R,G,B (colour; Y where there is one), Z (depth), coverage, or X,Y,Z (position). The same frame
// gives the same bytes, in the file and in memory. Throws std::runtime_error where the file cannot be
// written.
void writeFrame(const std::string& path, const Frame& frame, OutputKind output = OutputKind::color);
std::vector<uint8_t> encodeFrame(const Frame& frame, ImageFormat format,
                                 OutputKind output = OutputKind::color);

// Integer files are taken as sRGB and come back in linear light, float files as they are. One channel stays
// one; of two or four the last is alpha and left out. Throws InputError.
Frame readFrame(const std::string& path);

// The sRGB transfer function (IEC 61966-2-1), both ways; a byte survives the round trip unchanged. Light
// outside [0, 1] is clamped, NaN is black.
uint8_t srgbByteFromLinear(float linear);
float linearFromSrgbByte(uint8_t byte);

}  // namespace curvewall
