// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/archive/ZipArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <sys/stat.h>
#include <zip.h>

namespace reflet::importers {

struct ZipArchive::Handle {
    zip_t* zip = nullptr;
    std::string subject;

    ~Handle() {
        if (zip != nullptr)
            zip_discard(zip);
    }
};

namespace {

constexpr const char* kUnpack = "Unpack it and import the folder.";

tl::unexpected<Error> damaged(const std::string& subject, const std::string& reason) {
    return fail(ErrorCode::Unreadable, "cannot be read as a ZIP archive: " + reason, subject,
                "Download it again, or unpack it and import the folder.");
}

/// Files that are left out for one reason.
class LeftOut {
public:
    LeftOut(const char* code, const char* text, const char* remedy)
        : m_code(code), m_text(text), m_remedy(remedy) {}
    void add(std::string_view name) {
        constexpr std::size_t kNamed = 3;
        if (m_count++ < kNamed)
            m_names += fmt::format("{}{:.80}", m_names.empty() ? "" : ", ", name);
    }
    void report(std::vector<Diagnostic>& into) const {
        if (m_count > 0)
            into.push_back(
                {Severity::Warning, m_code, "",
                 fmt::format("{} of its files {} and {} left out: {}{}", m_count, m_text,
                             m_count == 1 ? "was" : "were", m_names, m_count > 3 ? ", ..." : ""),
                 m_remedy});
    }

private:
    const char* m_code;
    const char* m_text;
    const char* m_remedy;
    std::size_t m_count = 0;
    std::string m_names;
};

bool isLink(zip_t* zip, std::uint64_t index) {
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    constexpr unsigned kModeShift = 16;
    return zip_file_get_external_attributes(zip, index, 0, &system, &attributes) == 0 &&
           system == ZIP_OPSYS_UNIX && S_ISLNK(attributes >> kModeShift);
}

/// The paths that are taken. A file cannot lie below another file.
class Names {
public:
    [[nodiscard]] bool take(const std::string& path) {
        if (m_files.contains(path) || m_folders.contains(path))
            return false;
        std::vector<std::string> above;
        for (std::size_t slash = path.find('/'); slash != std::string::npos;
             slash = path.find('/', slash + 1))
            above.push_back(path.substr(0, slash));
        for (const std::string& folder : above) {
            if (m_files.contains(folder))
                return false;
        }
        m_folders.insert(above.begin(), above.end());
        m_files.insert(path);
        return true;
    }

private:
    std::set<std::string> m_files, m_folders;
};

tl::unexpected<Error> tooMuch(const std::string& subject, const std::string& what) {
    return fail(ErrorCode::ResourceLimit, what, subject,
                "If you trust it, unpack it yourself and import the folder.");
}

Result<void> checkSizes(std::size_t bytes, std::size_t packed, const ArchiveLimits& limits,
                        const std::string& subject) {
    constexpr double kGigabyte = 1e9;
    if (bytes > limits.maxBytes)
        return tooMuch(subject,
                       fmt::format("would unpack to {:.1f} GB, more than the limit of "
                                   "{:.1f} GB",
                                   double(bytes) / kGigabyte, double(limits.maxBytes) / kGigabyte));
    const double ratio = double(bytes) / double(std::max<std::size_t>(packed, 1));
    if (bytes > limits.freelyBytes && ratio > limits.maxRatio)
        return tooMuch(subject, fmt::format("would unpack to {:.0f} times its size, as no city "
                                            "does (the limit is {:.0f})",
                                            ratio, limits.maxRatio));
    return {};
}

}  // namespace

std::string confinedName(std::string_view name) {
    constexpr std::size_t kLongestPart = 255;
    constexpr std::size_t kLongest = 2048;
    if (name.empty() || name.size() > kLongest || name.front() == '/' || name.front() == '\\' ||
        name.find('\0') != std::string_view::npos || (name.size() > 1 && name[1] == ':'))
        return {};
    std::string path;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find_first_of("/\\", begin), name.size());
        const std::string_view part = name.substr(begin, end - begin);
        if (part == ".." || part.size() > kLongestPart || (end == name.size() && part.empty()))
            return {};
        if (!part.empty() && part != ".")
            path += (path.empty() ? "" : "/") + std::string(part);
        else if (end == name.size())
            return {};
        begin = end + 1;
    }
    return path;
}

Result<ZipArchive> ZipArchive::open(const std::filesystem::path& path,
                                    const ArchiveLimits& limits) {
    auto handle = std::make_shared<Handle>();
    handle->subject = path.string();
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error)
        return fail(ErrorCode::Unreadable, "cannot be read: " + error.message(), path.string(),
                    "Check the name and the permissions.");
    int code = 0;
    handle->zip = zip_open(path.c_str(), ZIP_RDONLY, &code);
    if (handle->zip == nullptr) {
        zip_error_t reason;
        zip_error_init_with_code(&reason, code);
        const std::string text = zip_error_strerror(&reason);
        zip_error_fini(&reason);
        return damaged(path.string(), text);
    }
    ZipArchive archive(std::move(handle));
    if (auto listed = archive.list(std::size_t(size), limits); !listed)
        return tl::unexpected(listed.error());
    return archive;
}

Result<ZipArchive> ZipArchive::openBytes(std::string_view bytes, const std::filesystem::path& path,
                                         const ArchiveLimits& limits) {
    auto handle = std::make_shared<Handle>();
    handle->subject = path.string();
    zip_error_t reason;
    zip_error_init(&reason);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &reason);
    if (source != nullptr) {
        handle->zip = zip_open_from_source(source, ZIP_RDONLY, &reason);
        if (handle->zip == nullptr)
            zip_source_free(source);
    }
    const std::string text = zip_error_strerror(&reason);
    zip_error_fini(&reason);
    if (handle->zip == nullptr)
        return damaged(path.string(), text);
    ZipArchive archive(std::move(handle));
    if (auto listed = archive.list(bytes.size(), limits); !listed)
        return tl::unexpected(listed.error());
    return archive;
}

Result<void> ZipArchive::list(std::size_t packedBytes, const ArchiveLimits& limits) {
    zip_t* zip = m_handle->zip;
    const std::string& subject = m_handle->subject;
    const auto count = std::uint64_t(std::max<zip_int64_t>(zip_get_num_entries(zip, 0), 0));
    if (count > limits.maxEntries)
        return tooMuch(subject, fmt::format("holds {} files, more than the limit of {}", count,
                                            limits.maxEntries));
    LeftOut outside("archive-outside", "lie outside the archive's own folder, or twice in it",
                    "Pack the archive anew.");
    LeftOut links("archive-link", "are links", "Pack the files themselves.");
    LeftOut encrypted("archive-encrypted", "are encrypted", kUnpack);
    LeftOut large("archive-large", "are larger than the limit of a file", kUnpack);
    Names names;
    std::size_t bytes = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        zip_stat_t stat;
        zip_stat_init(&stat);
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE;
        if (zip_stat_index(zip, i, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded)
            return damaged(subject, fmt::format("nothing is known of its file {}", i));
        const std::string_view name = stat.name;
        if (name.ends_with('/') || name.ends_with('\\'))
            continue;
        std::string path = confinedName(name);
        if (path.empty() || path.starts_with("__MACOSX/")) {
            if (path.empty())
                outside.add(name);
            continue;
        }
        if (isLink(zip, i)) {
            links.add(name);
        } else if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 &&
                   stat.encryption_method != ZIP_EM_NONE) {
            encrypted.add(name);
        } else if (stat.size > limits.maxEntryBytes) {
            large.add(name);
        } else if (!names.take(path)) {
            outside.add(name);
        } else {
            bytes += std::size_t(stat.size);
            m_entries.push_back({i, std::move(path), std::size_t(stat.size)});
        }
    }
    for (const LeftOut* reason : {&outside, &links, &encrypted, &large})
        reason->report(m_remarks);
    std::sort(m_entries.begin(), m_entries.end(),
              [](const ArchiveEntry& a, const ArchiveEntry& b) { return a.path < b.path; });
    return checkSizes(bytes, packedBytes, limits, subject);
}

Result<void> ZipArchive::read(const ArchiveEntry& entry, const Sink& sink,
                              const JobContext& job) const {
    const std::string subject = m_handle->subject + ": " + entry.path;
    zip_file_t* opened = zip_fopen_index(m_handle->zip, entry.index, 0);
    if (opened == nullptr)
        return fail(ErrorCode::Unreadable,
                    fmt::format("cannot be unpacked: {}", zip_strerror(m_handle->zip)), subject,
                    "Download the archive again, or unpack it and import the folder.");
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(opened, zip_fclose);
    std::vector<char> piece(std::size_t(256) << 10);
    std::size_t read = 0;
    for (;;) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const zip_int64_t count = zip_fread(file.get(), piece.data(), piece.size());
        if (count < 0)
            return fail(ErrorCode::Unreadable,
                        fmt::format("is damaged: {}", zip_file_strerror(file.get())), subject,
                        "Download the archive again, or pack it anew.");
        if (count == 0)
            break;
        read += std::size_t(count);
        if (read > entry.bytes)
            return tooMuch(subject, "unpacks to more than the archive says");
        if (auto taken = sink({piece.data(), std::size_t(count)}); !taken)
            return taken;
    }
    if (read < entry.bytes)
        return fail(ErrorCode::Unreadable, "is cut off", subject,
                    "Download the archive again, or pack it anew.");
    return {};
}

}  // namespace reflet::importers
