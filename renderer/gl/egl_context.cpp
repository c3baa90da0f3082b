#include "renderer/gl/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdlib>
#include <vector>

namespace curvewall {
namespace {

#ifdef NDEBUG
constexpr bool kDebugContext = false;
#else
constexpr bool kDebugContext = true;
#endif

void onGlMessage(GLenum source, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*) {
    // Mesa reports shaders that do not compile here as well; makeProgram() throws those with their file.
    if (type != GL_DEBUG_TYPE_ERROR || source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    spdlog::critical("OpenGL: {}", message);
    std::abort();  // our own bug
}

// Hardware devices first, then the surfaceless platform, then whatever else the device platform offers.
std::vector<EGLDisplay> candidateDisplays() {
    std::vector<EGLDisplay> hardware, software;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(devices.size(), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            EGLDeviceEXT device = devices[static_cast<size_t>(i)];
            const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
            const bool isSoftware =
                extensions &&
                std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
            (isSoftware ? software : hardware)
                .push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
        }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        hardware.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

EGLContext createCoreContext(EGLDisplay display) {
    constexpr std::array<EGLint, 5> configAttributes{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                                     EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!eglChooseConfig(display, configAttributes.data(), &config, 1, &configs) || configs == 0)
        return EGL_NO_CONTEXT;
    constexpr std::array<EGLint, 9> contextAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                                      4,
                                                      EGL_CONTEXT_MINOR_VERSION,
                                                      5,
                                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                      EGL_CONTEXT_OPENGL_DEBUG,
                                                      kDebugContext ? EGL_TRUE : EGL_FALSE,
                                                      EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes.data());
}

}  // namespace

struct EglContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    bool makeCurrent(EGLDisplay candidate) {
        EGLint major = 0, minor = 0;
        if (candidate == EGL_NO_DISPLAY || !eglInitialize(candidate, &major, &minor)) return false;
        if (!eglBindAPI(EGL_OPENGL_API)) return false;
        const EGLContext made = createCoreContext(candidate);
        if (made == EGL_NO_CONTEXT) return false;
        if (!eglMakeCurrent(candidate, EGL_NO_SURFACE, EGL_NO_SURFACE, made)) {
            eglDestroyContext(candidate, made);
            return false;
        }
        display = candidate;
        context = made;
        return true;
    }

    ~Handles() {
        if (context == EGL_NO_CONTEXT) return;
        // The display stays initialized: it is shared by every context of the process.
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
};

EglContext::EglContext() : handles_(std::make_unique<Handles>()) {
    bool current = false;
    for (EGLDisplay display : candidateDisplays())
        if (!current) current = handles_->makeCurrent(display);
    if (!current)
        throw GlUnavailable(
            "no OpenGL 4.5 core context could be made through EGL; install a driver, for example the Debian "
            "packages "
            "libegl1, libegl-mesa0 and libgl1-mesa-dri");
    rendererName_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    version_ = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    if (kDebugContext) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(onGlMessage, nullptr);
    }
}

EglContext::~EglContext() = default;

bool EglContext::isSoftware() const {
    for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"})
        if (rendererName_.find(name) != std::string::npos) return true;
    return false;
}

}  // namespace curvewall
