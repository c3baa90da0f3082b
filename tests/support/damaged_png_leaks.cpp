// For tests that decode damaged PNG files under LeakSanitizer.

// OpenImageIO 2.4 loses a string in PNGInput::PngReadCallback when a PNG ends early: libpng jumps over it.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libpng"; }  // NOLINT

// The libraries in between keep no frame pointers, and without them the stack of the leak ends before libpng.
extern "C" const char* __asan_default_options();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() { return "fast_unwind_on_malloc=0"; }  // NOLINT
