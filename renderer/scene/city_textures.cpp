// The city's materials and their textures, painted procedurally. Colours are sRGB bytes here.

#include "renderer/scene/city_materials.h"
#include "renderer/scene/random.h"
#include "renderer/scene/texture.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using Color = glm::vec3;

struct Area {
    int x = 0, y = 0, width = 0, height = 0;
};

// A fixed number in 0..1 for a lattice point.
float latticeValue(int x, int y, uint32_t key) {
    const auto position = static_cast<uint64_t>(static_cast<uint32_t>(x)) << 32 | static_cast<uint32_t>(y);
    return static_cast<float>(mixedBits(position ^ (static_cast<uint64_t>(key) << 20)) >> 40) * 0x1p-24f;
}

// Value noise in 0..1 over the unit square; `cells` lattice cells a side, tileable.
float tileableNoise(glm::vec2 uv, int cells, uint32_t key) {
    const glm::vec2 position = uv * static_cast<float>(cells);
    const int x = static_cast<int>(position.x), y = static_cast<int>(position.y);
    const float fx = position.x - static_cast<float>(x), fy = position.y - static_cast<float>(y);
    const float sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    const int x1 = (x + 1) % cells, y1 = (y + 1) % cells;
    const float upper = glm::mix(latticeValue(x, y, key), latticeValue(x1, y, key), sx);
    const float lower = glm::mix(latticeValue(x, y1, key), latticeValue(x1, y1, key), sx);
    return glm::mix(upper, lower, sy);
}

float cloudyNoise(glm::vec2 uv, int cells, uint32_t key) {
    return 0.55f * tileableNoise(uv, cells, key) + 0.3f * tileableNoise(uv, 3 * cells, key + 1) +
           0.15f * tileableNoise(uv, 9 * cells, key + 2);
}

class Canvas {
public:
    Canvas(glm::ivec2 sizePx, Color color)
        : sizePx_(sizePx), colors_(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y), color) {}

    glm::ivec2 sizePx() const { return sizePx_; }
    Color& at(int x, int y) {
        return colors_[static_cast<size_t>(y) * static_cast<size_t>(sizePx_.x) + static_cast<size_t>(x)];
    }
    glm::vec2 uv(int x, int y) const {
        return {(static_cast<float>(x) + 0.5f) / static_cast<float>(sizePx_.x),
                (static_cast<float>(y) + 0.5f) / static_cast<float>(sizePx_.y)};
    }

    // Areas must lie inside the canvas.
    void fill(Area area, Color color) {
        forEach(area, [&](int, int, Color& c) { c = color; });
    }
    void shade(Area area, float factor) {
        forEach(area, [&](int, int, Color& c) { c *= factor; });
    }
    // From `top` in the first row to `bottom` in the last one.
    void gradient(Area area, Color top, Color bottom) {
        forEach(area, [&](int, int y, Color& c) {
            c = glm::mix(top, bottom,
                         (static_cast<float>(y - area.y) + 0.5f) / static_cast<float>(area.height));
        });
    }
    void cloud(Area area, float amplitude, int cells, uint32_t key) {
        forEach(area, [&](int x, int y, Color& c) {
            c *= 1 + amplitude * (2 * cloudyNoise(uv(x, y), cells, key) - 1);
        });
    }
    void grain(Area area, float amplitude, uint32_t key) {
        forEach(area,
                [&](int x, int y, Color& c) { c *= 1 + amplitude * (2 * latticeValue(x, y, key) - 1); });
    }
    Area all() const { return {0, 0, sizePx_.x, sizePx_.y}; }

    Texture texture(std::string name, Wrap wrapT = Wrap::repeat) const {
        std::vector<glm::u8vec4> texels;
        texels.reserve(colors_.size());
        for (const Color& c : colors_) {
            const Color byte = glm::clamp(c, 0.0f, 255.0f) + 0.5f;
            texels.emplace_back(static_cast<uint8_t>(byte.r), static_cast<uint8_t>(byte.g),
                                static_cast<uint8_t>(byte.b), uint8_t{255});
        }
        return makeTexture(std::move(name), sizePx_, std::move(texels), Wrap::repeat, wrapT);
    }

private:
    template <class Function>
    void forEach(Area area, Function function) {
        for (int y = area.y; y < area.y + area.height; ++y)
            for (int x = area.x; x < area.x + area.width; ++x) function(x, y, at(x, y));
    }

    glm::ivec2 sizePx_;
    std::vector<Color> colors_;
};

constexpr int kCellPx = 64;  // one bay by one floor
constexpr int kFacadePx = kCellPx * kFacadeBays;
constexpr int kVariantPx = kCellPx * kFacadeVariantBays;

Area variantArea(int variant) { return {variant * kVariantPx, 0, kVariantPx, kFacadePx}; }

// Calls paint(cell, variant, random) for every bay and floor of a facade.
template <class Paint>
void forEachCell(uint32_t key, Paint paint) {
    for (int floor = 0; floor < kFacadeFloors; ++floor)
        for (int bay = 0; bay < kFacadeBays; ++bay) {
            Random random((static_cast<uint64_t>(key) << 32) +
                          static_cast<uint64_t>(floor * kFacadeBays + bay));
            paint(Area{bay * kCellPx, floor * kCellPx, kCellPx, kCellPx}, bay / kFacadeVariantBays, random);
        }
}

// Glass in a frame: the sky's reflection above, the room's darkness below, now and then a curtain.
void paintWindow(Canvas& canvas, Area area, Color frame, Random& random) {
    canvas.fill(area, frame);
    const Area glass{area.x + 2, area.y + 2, area.width - 4, area.height - 4};
    const float light = random.between(0.8f, 1.15f);
    canvas.gradient(glass, light * Color(104, 122, 140), light * Color(52, 60, 70));
    if (random.chance(0.35f)) {
        const int drop = static_cast<int>(random.between(0.25f, 0.7f) * static_cast<float>(glass.height));
        canvas.gradient({glass.x, glass.y, glass.width, drop}, Color(206, 200, 186), Color(178, 172, 160));
    }
    if (random.chance(0.08f)) canvas.gradient(glass, Color(228, 200, 140), Color(196, 160, 104));
    canvas.fill({area.x + area.width / 2 - 1, area.y, 2, area.height}, frame);
    canvas.fill({area.x, area.y + area.height / 3, area.width, 2}, frame);
}

void paintCourses(Canvas& canvas, Area area, glm::ivec2 stonePx, float amplitude, Color mortar,
                  uint32_t key) {
    for (int y = area.y; y < area.y + area.height; ++y) {
        const int row = y / stonePx.y;
        const int shift = row % 2 == 0 ? 0 : stonePx.x / 2;
        for (int x = area.x; x < area.x + area.width; ++x) {
            const int column = (x + shift) % kVariantPx / stonePx.x;
            const bool joint = y % stonePx.y == 0 || (x + shift) % stonePx.x == 0;
            Color& c = canvas.at(x, y);
            c = joint ? glm::mix(c, mortar, 0.55f)
                      : c * (1 + amplitude * (2 * latticeValue(column, row, key) - 1));
        }
    }
}

Texture brickFacade() {
    Canvas canvas({kFacadePx, kFacadePx}, {});
    canvas.fill(variantArea(0), {150, 82, 64});
    canvas.fill(variantArea(1), {178, 138, 98});
    for (int v = 0; v < 2; ++v) paintCourses(canvas, variantArea(v), {8, 4}, 0.14f, {176, 164, 150}, 11);
    canvas.cloud(canvas.all(), 0.10f, 6, 12);
    forEachCell(13, [&](Area cell, int variant, Random& random) {
        const Color stone = variant == 0 ? Color(196, 186, 168) : Color(150, 98, 76);
        canvas.fill({cell.x + 16, cell.y + 8, 32, 5}, stone);
        canvas.fill({cell.x + 15, cell.y + 51, 34, 4}, 0.94f * stone);
        canvas.shade({cell.x + 15, cell.y + 55, 34, 2}, 0.72f);
        paintWindow(canvas, {cell.x + 19, cell.y + 13, 26, 38}, {222, 218, 208}, random);
    });
    return canvas.texture("brick");
}

Texture plasterFacade() {
    Canvas canvas({kFacadePx, kFacadePx}, {});
    canvas.fill(variantArea(0), {222, 200, 156});
    canvas.fill(variantArea(1), {186, 196, 180});
    canvas.cloud(canvas.all(), 0.07f, 5, 21);
    canvas.grain(canvas.all(), 0.03f, 22);
    forEachCell(23, [&](Area cell, int variant, Random& random) {
        const Color trim = variant == 0 ? Color(240, 232, 214) : Color(232, 232, 224);
        const Color shutter = variant == 0 ? Color(84, 112, 92) : Color(128, 82, 64);
        canvas.fill({cell.x, cell.y + 60, cell.width, 3}, trim);
        canvas.shade({cell.x, cell.y + 63, cell.width, 1}, 0.8f);
        canvas.fill({cell.x + 18, cell.y + 9, 28, 43}, trim);
        paintWindow(canvas, {cell.x + 21, cell.y + 12, 22, 38}, {236, 234, 228}, random);
        if (random.chance(0.8f))
            for (const int x : {cell.x + 8, cell.x + 46}) {
                canvas.fill({x, cell.y + 12, 10, 38}, shutter);
                for (int y = cell.y + 14; y < cell.y + 49; y += 3) canvas.shade({x + 1, y, 8, 1}, 0.78f);
            }
    });
    return canvas.texture("plaster");
}

Texture stoneFacade() {
    Canvas canvas({kFacadePx, kFacadePx}, {});
    canvas.fill(variantArea(0), {196, 184, 160});
    canvas.fill(variantArea(1), {170, 164, 154});
    for (int v = 0; v < 2; ++v) paintCourses(canvas, variantArea(v), {32, 16}, 0.06f, {112, 106, 98}, 31);
    canvas.cloud(canvas.all(), 0.09f, 4, 32);
    forEachCell(33, [&](Area cell, int, Random& random) {
        canvas.shade({cell.x + 13, cell.y + 4, 38, 6}, 1.16f);
        canvas.shade({cell.x + 13, cell.y + 10, 4, 46}, 1.1f);
        canvas.shade({cell.x + 47, cell.y + 10, 4, 46}, 1.1f);
        paintWindow(canvas, {cell.x + 17, cell.y + 10, 30, 46}, {92, 84, 76}, random);
        canvas.shade({cell.x + 17, cell.y + 10, 30, 3}, 0.6f);
        canvas.shade({cell.x + 11, cell.y + 56, 42, 4}, 1.14f);
        canvas.shade({cell.x + 11, cell.y + 60, 42, 2}, 0.76f);
    });
    return canvas.texture("stone");
}

Texture glassFacade() {
    Canvas canvas({kFacadePx, kFacadePx}, {});
    forEachCell(41, [&](Area cell, int variant, Random& random) {
        const Color tint = variant == 0 ? Color(118, 150, 166) : Color(148, 140, 122);
        for (int pane = 0; pane < 2; ++pane) {
            const float light = random.between(0.86f, 1.12f);
            const Area glass{cell.x + pane * 32, cell.y, 32, 48};
            canvas.gradient(glass, light * tint, light * 0.78f * tint);
            if (random.chance(0.12f)) canvas.shade({glass.x, glass.y, 32, 20}, 1.22f);
        }
        canvas.fill({cell.x, cell.y + 48, cell.width, 16}, 0.52f * tint);
        const Color metal = variant == 0 ? Color(186, 192, 196) : Color(92, 80, 66);
        for (const int x : {cell.x, cell.x + 32}) canvas.fill({x, cell.y, 3, cell.height}, metal);
        canvas.fill({cell.x, cell.y + 47, cell.width, 2}, metal);
    });
    canvas.cloud(canvas.all(), 0.06f, 3, 42);
    return canvas.texture("glass");
}

Texture concreteFacade() {
    Canvas canvas({kFacadePx, kFacadePx}, {});
    canvas.fill(variantArea(0), {190, 188, 182});
    canvas.fill(variantArea(1), {208, 194, 176});
    canvas.cloud(canvas.all(), 0.08f, 5, 51);
    canvas.grain(canvas.all(), 0.03f, 52);
    forEachCell(53, [&](Area cell, int variant, Random& random) {
        canvas.shade({cell.x, cell.y, cell.width, 2}, 0.8f);
        canvas.shade({cell.x, cell.y, 1, cell.height}, 0.86f);
        paintWindow(canvas, {cell.x + 4, cell.y + 12, 40, 30}, {70, 74, 78}, random);
        const Color panel = variant == 0 ? Color(104, 132, 150) : Color(176, 106, 72);
        canvas.fill({cell.x + 46, cell.y + 12, 14, 30}, random.between(0.9f, 1.08f) * panel);
        canvas.shade({cell.x + 4, cell.y + 42, 56, 2}, 0.7f);
    });
    return canvas.texture("concrete");
}

// Eight shops of one bay and one ground floor each.
Texture shopFronts() {
    constexpr int kHeightPx = 96;
    Canvas canvas({kFacadePx, kHeightPx}, {150, 144, 134});
    canvas.cloud(canvas.all(), 0.08f, 8, 61);
    constexpr std::array<Color, 8> kSigns{{{128, 44, 40},
                                           {40, 72, 104},
                                           {58, 88, 62},
                                           {196, 160, 72},
                                           {72, 66, 70},
                                           {168, 96, 56},
                                           {70, 104, 110},
                                           {204, 196, 180}}};
    for (int bay = 0; bay < kFacadeBays; ++bay) {
        Random random(600 + static_cast<uint64_t>(bay));
        const int x = bay * kCellPx;
        const Color sign = kSigns[static_cast<size_t>(bay)];
        canvas.gradient({x + 2, 6, 60, 18}, 1.08f * sign, 0.9f * sign);
        const Color letters = bay == 3 || bay == 7 ? Color(60, 52, 46) : Color(232, 226, 210);
        for (int letter = x + 12; letter < x + 50; letter += 5)
            if (random.chance(0.8f)) canvas.fill({letter, 12, 3, 7}, letters);
        canvas.fill({x + 3, 26, 58, 64}, {58, 56, 54});
        const float light = random.between(0.85f, 1.2f);
        canvas.gradient({x + 5, 28, 36, 52}, light * Color(150, 142, 122), light * Color(92, 86, 78));
        for (int shelf = 44; shelf < 78; shelf += 12)
            for (int item = x + 8; item < x + 36; item += 6)
                if (random.chance(0.7f))
                    canvas.fill(
                        {item, shelf - 5, 4, 7},
                        Color(random.between(90, 210), random.between(80, 180), random.between(70, 160)));
        canvas.fill({x + 5, 80, 36, 10}, 0.6f * sign);
        canvas.gradient({x + 44, 28, 14, 60}, {96, 108, 116}, {54, 60, 66});
        canvas.fill({x + 44, 70, 14, 18}, 0.7f * sign);
        canvas.shade({x, 90, kCellPx, 6}, 0.7f);
    }
    return canvas.texture("shop", Wrap::clampToEdge);
}

Texture groundTexture(const char* name, Color color, float clouds, int cells, float grain, uint32_t key) {
    Canvas canvas({256, 256}, color);
    canvas.cloud(canvas.all(), clouds, cells, key);
    canvas.grain(canvas.all(), grain, key + 5);
    return canvas.texture(name);
}

Texture grass() {
    Canvas canvas({256, 256}, {});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x)
            canvas.at(x, y) =
                glm::mix(Color(96, 112, 66), Color(136, 144, 92), cloudyNoise(canvas.uv(x, y), 6, 71));
    canvas.grain(canvas.all(), 0.12f, 72);
    return canvas.texture("grass");
}

Texture foliage() {
    Canvas canvas({256, 256}, {});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const float leaf = cloudyNoise(canvas.uv(x, y), 14, 81);
            canvas.at(x, y) =
                glm::mix(Color(44, 70, 32), Color(132, 158, 72), glm::smoothstep(0.25f, 0.8f, leaf));
        }
    canvas.grain(canvas.all(), 0.1f, 82);
    return canvas.texture("foliage");
}

Texture asphalt() {
    Canvas canvas({256, 256}, {92, 92, 94});
    canvas.cloud(canvas.all(), 0.12f, 3, 91);
    canvas.grain(canvas.all(), 0.1f, 92);
    canvas.shade({40, 150, 70, 46}, 0.86f);  // a mended patch
    return canvas.texture("asphalt");
}

// Four by four slabs.
Texture sidewalk() {
    Canvas canvas({256, 256}, {178, 172, 162});
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            canvas.shade({column * 64, row * 64, 64, 64}, 0.94f + 0.12f * latticeValue(column, row, 101));
    canvas.cloud(canvas.all(), 0.08f, 5, 102);
    canvas.grain(canvas.all(), 0.05f, 103);
    for (int line = 0; line < 256; line += 64) {
        canvas.shade({line, 0, 2, 256}, 0.72f);
        canvas.shade({0, line, 256, 2}, 0.72f);
    }
    return canvas.texture("sidewalk");
}

Texture roofTiles() {
    constexpr int kTilePx = 16;
    Canvas canvas({256, 256}, {168, 92, 66});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const int row = y / kTilePx, column = x / kTilePx;
            const float across = (static_cast<float>(x % kTilePx) - 7.5f) / 7.5f;
            const float along = static_cast<float>(y % kTilePx) / kTilePx;
            const float each = 0.88f + 0.24f * latticeValue(column, row, 111);
            canvas.at(x, y) *= each * (1.06f - 0.26f * across * across) * (0.78f + 0.3f * along);
        }
    canvas.cloud(canvas.all(), 0.1f, 4, 112);
    return canvas.texture("tiles");
}

Texture paintSwatches() {
    constexpr int kSwatchPx = 16;
    constexpr std::array<Color, size_t{kPaintColumns} * kPaintRows> kColors{{
        {236, 234, 228}, {198, 196, 190}, {150, 150, 148}, {92, 94, 96},    {40, 42, 44},   {232, 220, 190},
        {206, 186, 146}, {132, 96, 66},   {86, 62, 44},    {172, 92, 64},   {182, 48, 42},  {118, 40, 38},
        {208, 124, 52},  {222, 182, 66},  {96, 132, 72},   {46, 78, 58},    {62, 118, 118}, {60, 98, 150},
        {38, 54, 88},    {172, 178, 182}, {44, 54, 64},    {250, 240, 206}, {140, 84, 56},  {186, 136, 58},
    }};
    Canvas canvas({kSwatchPx * static_cast<int>(kPaintColumns), kSwatchPx * static_cast<int>(kPaintRows)},
                  {});
    for (size_t i = 0; i < kColors.size(); ++i)
        canvas.fill({static_cast<int>(i % kPaintColumns) * kSwatchPx,
                     static_cast<int>(i / kPaintColumns) * kSwatchPx, kSwatchPx, kSwatchPx},
                    kColors[i]);
    return canvas.texture("paint");
}

void addTextured(Scene& scene, Texture texture) {
    Material material;
    material.name = texture.name;
    material.texture = static_cast<int>(scene.textures.size());
    scene.textures.push_back(std::move(texture));
    scene.materials.push_back(std::move(material));
}

}  // namespace

void addCityMaterials(Scene& scene) {
    addTextured(scene, grass());
    addTextured(scene, asphalt());
    Material marking;
    marking.name = "marking";
    marking.baseColor = {0.68f, 0.67f, 0.62f, 1};
    scene.materials.push_back(marking);
    addTextured(scene, sidewalk());
    addTextured(scene, brickFacade());
    addTextured(scene, plasterFacade());
    addTextured(scene, stoneFacade());
    addTextured(scene, glassFacade());
    addTextured(scene, concreteFacade());
    addTextured(scene, shopFronts());
    addTextured(scene, groundTexture("flat roof", {134, 130, 124}, 0.14f, 5, 0.14f, 121));
    addTextured(scene, roofTiles());
    addTextured(scene, foliage());
    addTextured(scene, paintSwatches());
}

}  // namespace curvewall
