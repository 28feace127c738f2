// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/GzipSource.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <zlib.h>

namespace reflet::importers {

namespace {

constexpr std::size_t kBlock = std::size_t(1) << 18;

class GzipSource : public ByteSource {
public:
    GzipSource(InputFile file, std::size_t limit)
        : m_file(std::move(file)), m_limit(limit), m_block(kBlock) {
        constexpr int kGzipOnly = 16 + MAX_WBITS;
        m_ready = inflateInit2(&m_stream, kGzipOnly) == Z_OK;
    }
    ~GzipSource() override {
        if (m_ready)
            inflateEnd(&m_stream);
    }
    GzipSource(const GzipSource&) = delete;
    GzipSource& operator=(const GzipSource&) = delete;

    Result<std::size_t> read(std::span<char> into) override {
        std::size_t filled = 0;
        while (filled < into.size() && !m_done) {
            const auto count = unpack(into.subspan(filled));
            if (!count)
                return count;
            filled += *count;
            m_total += *count;
            if (m_total > m_limit)
                return fail(
                    ErrorCode::ResourceLimit,
                    "unpacks to more than the limit of " + std::to_string(m_limit) + " bytes",
                    m_file.path().string(), "Split it into tiles.");
        }
        return filled;
    }

    [[nodiscard]] Result<std::unique_ptr<ByteSource>> again() const override {
        auto file = InputFile::open(m_file.path());
        if (!file)
            return tl::unexpected<Error>(file.error());
        return unpackGzip(*std::move(file), m_limit);
    }
    [[nodiscard]] std::size_t size() const override { return m_file.size(); }

private:
    [[nodiscard]] tl::unexpected<Error> damaged(const char* what) const {
        return fail(ErrorCode::Unreadable, std::string("cannot be unpacked: ") + what,
                    m_file.path().string(), "Get the file again.");
    }

    /// Unpacks some bytes, perhaps none. A file may consist of several streams.
    Result<std::size_t> unpack(std::span<char> into) {
        if (!m_ready)
            return fail(ErrorCode::ResourceLimit, "there is no memory to unpack it",
                        m_file.path().string(), "Close something.");
        if (m_stream.avail_in == 0) {
            const auto count = m_file.read(m_block);
            if (!count)
                return count;
            m_done = *count == 0;
            if (m_done && !m_betweenStreams)
                return damaged("it is cut off");
            m_stream.next_in = reinterpret_cast<Bytef*>(m_block.data());
            m_stream.avail_in = static_cast<uInt>(*count);
        }
        if (m_done)
            return 0;
        constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
        const std::size_t room = std::min(into.size(), kMost);
        m_stream.next_out = reinterpret_cast<Bytef*>(into.data());
        m_stream.avail_out = static_cast<uInt>(room);
        const int state = inflate(&m_stream, Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
            return damaged("it is damaged");
        m_betweenStreams = state == Z_STREAM_END;
        if (m_betweenStreams)
            inflateReset(&m_stream);
        return room - m_stream.avail_out;
    }

    InputFile m_file;
    std::size_t m_limit;
    std::vector<char> m_block;
    z_stream m_stream{};
    std::size_t m_total = 0;
    bool m_ready = false;
    bool m_betweenStreams = false;
    bool m_done = false;
};

}  // namespace

bool looksLikeGzip(std::string_view start) {
    return start.starts_with("\x1f\x8b");
}

std::unique_ptr<ByteSource> unpackGzip(InputFile file, std::size_t limit) {
    return std::make_unique<GzipSource>(std::move(file), limit);
}

}  // namespace reflet::importers
