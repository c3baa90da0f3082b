#pragma once
// How far one picture is from another, on the 8-bit sRGB values that a viewer gets.

#include "renderer/frame.h"

namespace curvewall {

struct ImageDifference {
    double shareOff = 0;    // share of pixels with a channel off by more than 8 of 255
    double psnrDb = 0;      // over all channels, peak 255; infinite for equal pictures
    double ssim = 1;        // structural similarity of luma, 1 for equal pictures
    int maxDifference = 0;  // of any channel, of 255
};

// SSIM is that of Wang, Bovik, Sheikh and Simoncelli (2004) with K1 = 0.01 and K2 = 0.03: the mean over every
// position of a uniform 8 x 8 window (smaller where the picture is), on the luma of Rec. 709.
// Throws UsageError unless both are colour frames of one size.
ImageDifference compareColor(const Frame& a, const Frame& b);

}  // namespace curvewall
