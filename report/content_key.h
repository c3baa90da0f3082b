#pragma once
// Names for what something is made of: equal content, equal key. So what was computed once is found again,
// and never for something else.

#include "renderer/render.h"

#include <OpenImageIO/hash.h>

#include <span>
#include <string>
#include <string_view>

namespace curvewall {

class ContentKey {
public:
    void add(std::string_view text);
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void add(std::span<const T> values) {
        const uint64_t count = values.size();
        hash_.append(&count, sizeof count);
        hash_.append(values.data(), values.size_bytes());
    }
    void addNumber(double number) { hash_.append(&number, sizeof number); }

    // Hexadecimal; ends the key.
    std::string text() { return hash_.digest(); }

private:
    OIIO::SHA1 hash_;
};

// Of the program that runs, as it lies on the disk.
std::string keyOfThisProgram();

// Of what a frame of the request shows, whatever draws it: the scene's triangles, materials and texels, the
// rays of all pixels, blend maps, background, camera and style; of this program, since another version may
// draw it otherwise; and of the processor, since times are of one machine. What an OpenGL driver draws has
// its part beside it (GlDriver in machine.h).
std::string keyOfView(const RenderRequest& request);

}  // namespace curvewall
