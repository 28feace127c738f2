// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace reflet {

namespace {

tl::unexpected<Error> unreadable(const std::filesystem::path& path, int error) {
    return fail(ErrorCode::Unreadable, "cannot be read: " + std::generic_category().message(error),
                path.string(), "Check the name and the permissions.");
}

}  // namespace

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
    InputFile file(path, ::open(path.c_str(), O_RDONLY | O_CLOEXEC), 0);
    if (file.m_descriptor < 0)
        return unreadable(path, errno);
    struct stat status {};
    if (::fstat(file.m_descriptor, &status) != 0)
        return unreadable(path, errno);
    if (S_ISDIR(status.st_mode))
        return unreadable(path, EISDIR);
    file.m_size = static_cast<std::size_t>(std::max<off_t>(0, status.st_size));
    return file;
}

Result<std::size_t> InputFile::read(std::span<char> into) {
    std::size_t filled = 0;
    while (filled < into.size()) {
        const ssize_t count = ::read(m_descriptor, into.data() + filled, into.size() - filled);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return unreadable(m_path, errno);
        if (count == 0)
            break;
        filled += static_cast<std::size_t>(count);
    }
    return filled;
}

InputFile::InputFile(InputFile&& other) noexcept
    : m_path(std::move(other.m_path)),
      m_descriptor(std::exchange(other.m_descriptor, -1)),
      m_size(other.m_size) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
    std::swap(m_path, other.m_path);
    std::swap(m_descriptor, other.m_descriptor);
    std::swap(m_size, other.m_size);
    return *this;
}

InputFile::~InputFile() {
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

}  // namespace reflet
