#pragma once
// A request that leaves the method open: forecasts, trial frames where these are close, and the winner.

#include "renderer/method_choice.h"
#include "renderer/recently_used.h"

#include <functional>

namespace curvewall {

class AutomaticMethod {
public:
    // Renders a request whose method is settled.
    using RenderSettled = std::function<RenderResult(const RenderRequest&)>;

    // `request` comes with its pieces. What is chosen is kept for requests that differ in the camera only.
    RenderResult render(const RenderRequest& request, const Display& display, const RenderSettled& settled);

private:
    struct ChoiceKey {
        WallPtr wall;
        const Display* display;
        ScenePtr scene;
        double tolerancePx;
        int samples;
        Engine engine;
        SourceFilter filter;
        Style style;
        OutputKind output;
        bool operator==(const ChoiceKey&) const = default;
    };
    RecentlyUsed<ChoiceKey, const MethodChoice> choices_{32};
};

}  // namespace curvewall
