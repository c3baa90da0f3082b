#pragma once
// Frames to and from image files and encoded bytes. The only place that knows OpenImageIO.

#include "renderer/frame.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

enum class ImageFormat { png, jpeg, exr };

// From a file name's extension (.png, .jpg, .jpeg, .exr). Throws UsageError otherwise.
ImageFormat imageFormatFromPath(std::string_view path);

// PNG and JPEG are 8-bit sRGB and take colour only; EXR is linear float. Throws std::runtime_error.
void writeFrame(const std::string& path, const Frame& frame);
std::vector<uint8_t> encodeFrame(const Frame& frame, ImageFormat format);

// 8-bit sRGB files come back in linear light. Throws InputError.
Frame readFrame(const std::string& path);

// The sRGB transfer function (IEC 61966-2-1), both ways; a byte survives the round trip unchanged.
uint8_t srgbByteFromLinear(float linear);
float linearFromSrgbByte(uint8_t byte);

}  // namespace curvewall
