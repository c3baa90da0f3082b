#pragma once
// OpenGL 4.5 without a window system.

#include <memory>
#include <stdexcept>
#include <string>

namespace curvewall {

// There is no OpenGL that can do the work. Command line: exit code 4.
class GlUnavailable : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// A core context, current on the thread that makes it until it is destroyed. A hardware EGL device is
// preferred; without one, Mesa's surfaceless platform (llvmpipe). Debug builds ask for a debug context and
// abort on an OpenGL error.
class EglContext {
public:
    EglContext();  // throws GlUnavailable
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    const std::string& rendererName() const { return rendererName_; }
    const std::string& version() const { return version_; }  // of OpenGL, and what the driver calls its own
    bool isSoftware() const;                                 // one of Mesa's renderers without a GPU

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
    std::string rendererName_, version_;
};

}  // namespace curvewall
