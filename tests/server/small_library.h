#pragma once
// A library without files: the wall "small" with the displays "left" and "right", the scene "model".

#include "server/library.h"
#include "tests/support/test_projections.h"

#include <memory>

namespace curvewall {

inline Library smallLibrary() {
    auto wall = std::make_shared<Wall>();
    for (const char* name : {"left", "right"}) {
        Display display;
        display.name = name;
        display.sizePx = {100, 50};
        display.projection = std::make_shared<PinholeProjection>(display.sizePx, 50);
        wall->displays.push_back(display);
    }
    Library library;
    library.walls.emplace("small", wall);
    library.sceneFiles.emplace("model", "/scenes/model.glb");
    library.maxCityTriangles = 1000;
    return library;
}

}  // namespace curvewall
