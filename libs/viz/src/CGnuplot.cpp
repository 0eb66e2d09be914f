// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <salma/viz/CGnuplot.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace salma::viz {
namespace {

/// A file descriptor that closes itself.
class CDescriptor {
 public:
    CDescriptor(int descriptor, const std::string& name) : m_descriptor(descriptor) {
        if (descriptor < 0) throw std::runtime_error(name + ": " + std::strerror(errno));
    }
    ~CDescriptor() { close(m_descriptor); }
    CDescriptor(const CDescriptor&) = delete;
    CDescriptor& operator=(const CDescriptor&) = delete;
    int get() const { return m_descriptor; }

 private:
    int m_descriptor;
};

void writeAndRewind(int descriptor, const std::string& text) {
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t n = write(descriptor, text.data() + done, text.size() - done);
        if (n < 0) throw std::runtime_error(std::string("gnuplot script: ") + std::strerror(errno));
        done += static_cast<std::size_t>(n);
    }
    lseek(descriptor, 0, SEEK_SET);
}

/// The first line that says something, of what gnuplot wrote to standard error.
std::string complaint(int descriptor) {
    std::string text(4096, '\0');
    const ssize_t n = pread(descriptor, text.data(), text.size(), 0);
    text.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
    std::istringstream lines(text);
    std::string found;
    for (std::string line; std::getline(lines, line);) {
        const bool speaks = line.find_first_not_of(" \t^") != std::string::npos;
        if (line.find("line ") != std::string::npos) return line;  // "line 12: undefined ..."
        if (speaks && found.empty()) found = line;
    }
    return found.empty() ? "no message" : found;
}

/// Exit status of `gnuplot` with these as standard input, output and error.
int runChild(int in, int out, int err) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    std::string name = "gnuplot", dash = "-";
    std::array<char*, 3> arguments{name.data(), dash.data(), nullptr};
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw std::runtime_error(std::string("gnuplot cannot be started (") + std::strerror(error) +
                                 "); Debian has it as gnuplot-nox");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// gnuplot does not tell when the disk is full; a PNG that broke off lacks its last chunk.
bool isWholePng(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;
    const std::string end("IEND\xAE\x42\x60\x82", 8);
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    std::string tail(end.size(), '\0');
    in.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
    in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    return in && tail == end;
}

}  // namespace

CGnuplot::CGnuplot(int width, int height) {
    m_script << "set terminal pngcairo size " << width << "," << height
             << " background '#ffffff' font 'DejaVu Sans,13' noenhanced\n";
}

std::ostream& CGnuplot::data(const std::string& name) {
    m_script << "$" << name << " << EOD\n";
    return m_script;
}

void CGnuplot::run(const std::string& file) const {
    const CDescriptor script(memfd_create("gnuplot script", MFD_CLOEXEC), "gnuplot script");
    const CDescriptor complaints(memfd_create("gnuplot errors", MFD_CLOEXEC), "gnuplot errors");
    writeAndRewind(script.get(), m_script.str());
    int status = 0;
    {
        const CDescriptor picture(
            open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666), file);
        status = runChild(script.get(), picture.get(), complaints.get());
    }
    if (status != 0)
        throw std::runtime_error(file + ": gnuplot failed: " + complaint(complaints.get()));
    if (!isWholePng(file))
        throw std::runtime_error(file + ": cannot be written: " + complaint(complaints.get()));
}

}  // namespace salma::viz
