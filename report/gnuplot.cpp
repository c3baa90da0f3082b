#include "report/gnuplot.h"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <stdexcept>
#include <unistd.h>

namespace curvewall {
namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, FileCloser>;

TemporaryFile temporaryFile(std::string_view content = {}) {
    TemporaryFile file(std::tmpfile());
    if (!file || std::fwrite(content.data(), 1, content.size(), file.get()) != content.size() ||
        std::fflush(file.get()) != 0)
        throw std::runtime_error(std::string("cannot write a temporary file: ") + std::strerror(errno));
    std::rewind(file.get());
    return file;
}

std::string contentOf(std::FILE* file) {
    std::rewind(file);
    std::string content;
    std::array<char, 65536> part{};
    while (const size_t size = std::fread(part.data(), 1, part.size(), file))
        content.append(part.data(), size);
    return content;
}

class FileActions {
public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    void redirect(int target, std::FILE* file) {
        posix_spawn_file_actions_adddup2(&actions_, fileno(file), target);
    }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_{};
};

int exitStatusOf(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) throw std::runtime_error(std::string("gnuplot: ") + std::strerror(errno));
    return status;
}

}  // namespace

// Files rather than pipes: nobody has to write to one end while the other is read.
std::string gnuplotOutput(const std::string& script) {
    const TemporaryFile in = temporaryFile(script), out = temporaryFile(), errors = temporaryFile();
    FileActions actions;
    actions.redirect(STDIN_FILENO, in.get());
    actions.redirect(STDOUT_FILENO, out.get());
    actions.redirect(STDERR_FILENO, errors.get());
    std::string program = "gnuplot", defaults = "--default-settings";
    const std::array<char*, 3> arguments{program.data(), defaults.data(), nullptr};
    pid_t child = 0;
    if (const int error = posix_spawnp(&child, "gnuplot", actions.get(), nullptr, arguments.data(), environ))
        throw std::runtime_error(
            error == ENOENT
                ? std::string("plots need gnuplot, which is not there: install the package gnuplot-nox")
                : std::string("gnuplot: ") + std::strerror(error));
    const int status = exitStatusOf(child);
    std::string picture = contentOf(out.get());
    if (status != 0 || picture.empty())
        throw std::runtime_error("gnuplot failed: " + contentOf(errors.get()));
    return picture;
}

std::string gnuplotQuoted(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) {
        const bool isControl = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        quoted += isControl ? ' ' : c;
        if (c == '\'') quoted += c;
    }
    return quoted + "'";
}

}  // namespace curvewall
