// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ByteSource.h"

#include "core/base/InputFile.h"
#include "importers/common/GzipSource.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace reflet::importers {

namespace {

class FileSource : public ByteSource {
public:
    explicit FileSource(InputFile file) : m_file(std::move(file)) {}

    Result<std::size_t> read(std::span<char> into) override { return m_file.read(into); }
    [[nodiscard]] Result<std::unique_ptr<ByteSource>> again() const override {
        auto file = InputFile::open(m_file.path());
        if (!file)
            return tl::unexpected<Error>(file.error());
        return std::make_unique<FileSource>(*std::move(file));
    }
    [[nodiscard]] std::size_t size() const override { return m_file.size(); }

private:
    InputFile m_file;
};

class MemorySource : public ByteSource {
public:
    explicit MemorySource(std::string_view bytes) : m_bytes(bytes) {}

    Result<std::size_t> read(std::span<char> into) override {
        const std::size_t count = m_bytes.copy(into.data(), into.size(), m_at);
        m_at += count;
        return count;
    }
    [[nodiscard]] Result<std::unique_ptr<ByteSource>> again() const override {
        return std::make_unique<MemorySource>(m_bytes);
    }
    [[nodiscard]] std::size_t size() const override { return m_bytes.size(); }

private:
    std::string_view m_bytes;
    std::size_t m_at = 0;
};

}  // namespace

Result<std::unique_ptr<ByteSource>> openFile(const std::filesystem::path& path, std::size_t limit) {
    auto file = InputFile::open(path);
    if (!file)
        return tl::unexpected<Error>(file.error());
    if (file->size() > limit) {
        return fail(ErrorCode::ResourceLimit,
                    "is larger than the limit of " + std::to_string(limit) + " bytes",
                    path.string(), "Split it into tiles.");
    }
    std::array<char, 2> start{};
    const auto count = file->read(start);
    if (!count)
        return tl::unexpected<Error>(count.error());
    const bool packed = looksLikeGzip(std::string_view(start.data(), *count));
    file = InputFile::open(path);
    if (!file)
        return tl::unexpected<Error>(file.error());
    if (packed)
        return unpackGzip(*std::move(file), limit);
    return std::make_unique<FileSource>(*std::move(file));
}

Result<std::string> readAll(ByteSource& source, const JobContext& job) {
    constexpr std::size_t kBlock = std::size_t(1) << 20;
    std::string bytes;
    bytes.reserve(source.size());
    for (;;) {
        const std::size_t before = bytes.size();
        if (job.cancelled())
            return tl::unexpected<Error>(JobContext::cancelledError());
        bytes.resize(before + kBlock);
        const auto count = source.read(std::span(bytes).subspan(before));
        if (!count)
            return tl::unexpected<Error>(count.error());
        bytes.resize(before + *count);
        if (*count < kBlock)
            return bytes;
    }
}

std::unique_ptr<ByteSource> openBytes(std::string_view bytes) {
    return std::make_unique<MemorySource>(bytes);
}

}  // namespace reflet::importers
