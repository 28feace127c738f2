// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/VideoWriter.h"

#include "core/base/Files.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <signal.h>
#include <spawn.h>
#include <sstream>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace reflet {

namespace {

namespace fs = std::filesystem;

constexpr const char* kQuality = "20";  // x264's crf: hard to tell from the original

std::optional<fs::path> ffmpeg() {
    const char* variable = std::getenv("PATH");
    std::istringstream folders(variable != nullptr ? variable : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::path(folder.empty() ? "." : folder) / "ffmpeg";
        std::error_code error;
        if (fs::is_regular_file(program, error) && ::access(program.c_str(), X_OK) == 0)
            return program;
    }
    return std::nullopt;
}

/// A name beside `path` that nobody else uses.
fs::path temporaryBeside(const fs::path& path) {
    static int number = 0;
    return path.parent_path() /
           fmt::format(".{}.{}-{}.part", path.filename().string(), int(::getpid()), ++number);
}

Error writeFailed(const fs::path& path, const std::string& what) {
    return {ErrorCode::WriteFailed,
            what,
            path.string(),
            "Check that the folder exists, is writable and has space.",
            {}};
}

/// Rows without their last pixel where the width is odd, and without the last row.
std::span<const std::uint8_t> cropped(std::span<const std::uint8_t> rgb,
                                      const VideoWriter::Format& format,
                                      std::vector<std::uint8_t>& buffer) {
    const auto width = std::size_t(format.width);
    const std::size_t evenWidth = width & ~std::size_t(1);
    const std::size_t evenHeight = std::size_t(format.height) & ~std::size_t(1);
    if (evenWidth == width)
        return rgb.first(3 * width * evenHeight);
    buffer.resize(3 * evenWidth * evenHeight);
    for (std::size_t row = 0; row < evenHeight; ++row)
        std::memcpy(&buffer[3 * row * evenWidth], &rgb[3 * row * width], 3 * evenWidth);
    return buffer;
}

/// A running ffmpeg that reads raw pictures.
class FfmpegWriter final : public VideoWriter {
public:
    FfmpegWriter(fs::path path, const Format& format)
        : m_path(std::move(path)), m_part(temporaryBeside(m_path)), m_format(format) {}
    ~FfmpegWriter() override {
        closeInput();
        if (m_process > 0) {
            ::kill(m_process, SIGKILL);
            ::waitpid(m_process, nullptr, 0);
        }
        if (m_messages != nullptr)
            std::fclose(m_messages);
        std::error_code error;
        fs::remove(m_part, error);
    }

    Result<void> start(const fs::path& program) {
        // A socket, because writing to one whose reader has died can be told not to raise SIGPIPE.
        int ends[2] = {-1, -1};
        m_messages = std::tmpfile();
        if (m_messages == nullptr ||
            ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
            return tl::unexpected(writeFailed(m_path, std::strerror(errno)));
        }
        m_input = ends[0];
        const int started = spawn(program, ends[1]);
        ::close(ends[1]);
        if (started != 0) {
            m_process = -1;
            return fail(ErrorCode::WriteFailed,
                        fmt::format("ffmpeg cannot be started: {}", std::strerror(started)),
                        program.string(), "Install ffmpeg anew.");
        }
        return {};
    }

    Result<void> add(std::span<const std::uint8_t> rgb) override {
        std::span<const std::uint8_t> rest = cropped(rgb, m_format, m_buffer);
        while (!rest.empty()) {
            const ssize_t sent = ::send(m_input, rest.data(), rest.size(), MSG_NOSIGNAL);
            if (sent < 0 && errno == EINTR)
                continue;
            if (sent < 0) {
                wait();
                return tl::unexpected(failure());
            }
            rest = rest.subspan(std::size_t(sent));
        }
        return {};
    }

    Result<fs::path> finish() override {
        closeInput();
        if (wait() != 0)
            return tl::unexpected(failure());
        std::error_code error;
        fs::rename(m_part, m_path, error);
        if (error)
            return tl::unexpected(writeFailed(m_path, error.message()));
        return m_path;
    }

private:
    int spawn(const fs::path& program, int input) {
        const std::string size = fmt::format("{}x{}", m_format.width & ~1, m_format.height & ~1);
        const std::string rate = std::to_string(m_format.framesPerSecond);
        std::vector<std::string> words{program.string(),
                                       "-v",
                                       "error",
                                       "-nostdin",
                                       "-y",
                                       "-f",
                                       "rawvideo",
                                       "-pix_fmt",
                                       "rgb24",
                                       "-s",
                                       size,
                                       "-r",
                                       rate,
                                       "-i",
                                       "pipe:0",
                                       "-c:v",
                                       "libx264",
                                       "-pix_fmt",
                                       "yuv420p",
                                       "-crf",
                                       kQuality,
                                       "-movflags",
                                       "+faststart",
                                       "-f",
                                       "mp4",
                                       m_part.string()};
        std::vector<char*> arguments;
        for (auto& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, ::fileno(m_messages), STDERR_FILENO);
        const int result = ::posix_spawn(&m_process, program.c_str(), &actions, nullptr,
                                         arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        return result;
    }

    void closeInput() {
        if (m_input >= 0)
            ::close(m_input);
        m_input = -1;
    }

    /// The exit status; 0 when all went well.
    int wait() {
        int status = -1;
        if (m_process <= 0)
            return status;
        while (::waitpid(m_process, &status, 0) < 0 && errno == EINTR) {
        }
        m_process = -1;
        return status;
    }

    [[nodiscard]] Error failure() const {
        std::rewind(m_messages);
        std::array<char, 2000> text{};
        const std::size_t length = std::fread(text.data(), 1, text.size(), m_messages);
        std::string words(text.data(), length);
        while (!words.empty() && std::isspace(static_cast<unsigned char>(words.back())) != 0)
            words.pop_back();
        return {ErrorCode::WriteFailed,
                "ffmpeg could not write the film" + (words.empty() ? "" : ": " + words),
                m_path.string(),
                "Check that the folder is writable and has space, and that this ffmpeg has "
                "libx264.",
                {}};
    }

    fs::path m_path, m_part;
    Format m_format;
    int m_input = -1;
    pid_t m_process = -1;
    std::FILE* m_messages = nullptr;  ///< what ffmpeg says
    std::vector<std::uint8_t> m_buffer;
};

/// Numbered pictures in a folder.
class PictureWriter final : public VideoWriter {
public:
    PictureWriter(fs::path folder, const Format& format)
        : m_folder(std::move(folder)), m_part(temporaryBeside(m_folder)), m_format(format) {}
    ~PictureWriter() override {
        std::error_code error;
        fs::remove_all(m_part, error);
    }

    Result<void> start() {
        std::error_code error;
        if (fs::exists(m_folder, error) && !fs::is_empty(m_folder, error)) {
            return fail(ErrorCode::WriteFailed, "there is a folder of that name already",
                        m_folder.string(), "Choose another name, or install ffmpeg for one file.");
        }
        return makeFolder(m_part);
    }

    Result<void> add(std::span<const std::uint8_t> rgb) override {
        const auto bytes = cropped(rgb, m_format, m_buffer);
        DisplayImage image{m_format.width & ~1, m_format.height & ~1, {}};
        image.pixels.reserve(bytes.size() / 3);
        for (std::size_t i = 0; i + 2 < bytes.size(); i += 3)
            image.pixels.push_back(glm::vec3(bytes[i], bytes[i + 1], bytes[i + 2]) / 255.0F);
        return writePng(image, m_part / fmt::format("frame-{:05}.png", ++m_count));
    }

    Result<fs::path> finish() override {
        std::error_code error;
        fs::remove(m_folder, error);  // an empty one is in the way of renaming
        fs::rename(m_part, m_folder, error);
        if (error)
            return tl::unexpected(writeFailed(m_folder, error.message()));
        return m_folder;
    }

private:
    fs::path m_folder, m_part;
    Format m_format;
    int m_count = 0;
    std::vector<std::uint8_t> m_buffer;
};

}  // namespace

bool isFfmpegThere() {
    return ffmpeg().has_value();
}

Result<std::unique_ptr<VideoWriter>> VideoWriter::open(const fs::path& path, const Format& format,
                                                       Encoder encoder) {
    constexpr int largest = 16384;
    if (format.width < 2 || format.height < 2 || format.width > largest ||
        format.height > largest || format.framesPerSecond < 1 || format.framesPerSecond > 240) {
        return fail(ErrorCode::Usage, "a film cannot have that size or rate", path.string(),
                    "Take 2 to 16384 pixels and 1 to 240 pictures a second.");
    }
    if (const auto folder = fs::absolute(path).parent_path(); ::access(folder.c_str(), W_OK) != 0)
        return tl::unexpected(writeFailed(path, "the film cannot be written there"));
    const auto program = ffmpeg();
    if (program && encoder == Encoder::FfmpegOrPictures) {
        auto writer = std::make_unique<FfmpegWriter>(fs::absolute(path), format);
        if (auto started = writer->start(*program); !started)
            return tl::unexpected(started.error());
        return writer;
    }
    auto writer = std::make_unique<PictureWriter>(fs::absolute(path).replace_extension(), format);
    if (auto started = writer->start(); !started)
        return tl::unexpected(started.error());
    return writer;
}

}  // namespace reflet
