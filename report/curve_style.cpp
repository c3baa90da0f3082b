#include "report/curve_style.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace curvewall {
namespace {

// The colours of Okabe and Ito (2008), without the yellow, which is too pale for lines on white.
constexpr const char* kBlue = "#0072b2";
constexpr const char* kSkyBlue = "#56b4e9";
constexpr const char* kVermilion = "#d55e00";
constexpr const char* kOrange = "#e69f00";
constexpr const char* kGreen = "#009e73";
constexpr const char* kPurple = "#cc79a7";
constexpr const char* kGrey = "#808080";

enum Mark {
    openSquare = 4,
    square,
    openCircle,
    circle,
    openTriangle,
    triangle,
    openTriangleDown,
    triangleDown,
    openDiamond,
    diamond,
    openPentagon,
    pentagon
};

struct NamedStyle {
    std::string_view begin;  // of the curve's name
    const char* color;
    Mark mark;
};

// The longest that fits counts.
constexpr std::array kNamedStyles{
    NamedStyle{"piecewise", kBlue, circle},
    NamedStyle{"piecewise, geometry engine", kSkyBlue, openCircle},
    NamedStyle{"piecewise, tessellation engine", kSkyBlue, openDiamond},
    NamedStyle{"piecewise, loop engine", kSkyBlue, openPentagon},
    NamedStyle{"image-based", kVermilion, square},
    NamedStyle{"image-based, cube, nearest", kVermilion, diamond},
    NamedStyle{"image-based, cube, bicubic", kVermilion, openSquare},
    NamedStyle{"image-based, cube, mipmap", kOrange, diamond},
    NamedStyle{"image-based, cube, anisotropic", kOrange, openDiamond},
    NamedStyle{"image-based, planar", kOrange, triangle},
    NamedStyle{"image-based, hemicube", kOrange, pentagon},
    NamedStyle{"bounded-raycast", kGreen, triangle},
    NamedStyle{"bounded-raycast, quad", kGreen, openDiamond},
    NamedStyle{"vertex-warp", kPurple, triangleDown},
    NamedStyle{"reference", kGrey, pentagon},
};

constexpr std::array kOtherColors{kOrange, kSkyBlue, kGreen, kPurple, kVermilion, kBlue, kGrey};

// "image-based, cube" begins "image-based, cube, linear", and not "image-based, cubes".
bool begins(std::string_view begin, std::string_view name) {
    return name.starts_with(begin) && (name.size() == begin.size() || name[begin.size()] == ',');
}

const NamedStyle* namedStyle(std::string_view name) {
    const NamedStyle* longest = nullptr;
    for (const NamedStyle& style : kNamedStyles)
        if (begins(style.begin, name) && (!longest || style.begin.size() > longest->begin.size()))
            longest = &style;
    return longest;
}

}  // namespace

std::vector<CurveStyle> curveStyles(const std::vector<std::string>& names) {
    std::vector<CurveStyle> styles;
    size_t others = 0;
    for (const std::string& name : names) {
        const NamedStyle* named = namedStyle(name);
        CurveStyle style = named ? CurveStyle{named->color, named->mark}
                                 : CurveStyle{kOtherColors[others++ % kOtherColors.size()], diamond};
        const int first = style.mark;
        while (std::ranges::find(styles, style) != styles.end()) {
            style.mark = style.mark == pentagon ? openSquare : style.mark + 1;
            if (style.mark == first) break;
        }
        styles.push_back(style);
    }
    return styles;
}

}  // namespace curvewall
