#pragma once
// A request to the reference. Needs no GL context.

#include "renderer/recently_used.h"
#include "renderer/reference.h"
#include "renderer/render.h"

namespace curvewall {

class ReferenceMethod {
public:
    explicit ReferenceMethod(size_t mostScenes) : references_(mostScenes) {}

    RenderResult render(const RenderRequest& request, const Display& display);

private:
    RecentlyUsed<ScenePtr, ReferenceRenderer> references_;
};

}  // namespace curvewall
