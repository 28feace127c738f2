// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/ObjFile.h"

#include "importers/obj/ObjText.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace reflet::obj {

namespace {

constexpr std::size_t kLongestLine = std::size_t(16) << 20;
constexpr std::size_t kMost = 200'000'000;  // corners, vertices
constexpr std::size_t kLongestName = 1024;
constexpr std::int64_t kNoIndex = std::numeric_limits<std::int64_t>::min();

/// Names with their numbers in the order in which they came.
class NameList {
public:
    explicit NameList(std::vector<std::string>& names) : m_names(names) { m_numbers[""] = 0; }
    std::uint32_t operator()(std::string_view name) {
        const auto [known, isNew] = m_numbers.try_emplace(std::string(name.substr(0, kLongestName)),
                                                          std::uint32_t(m_names.size()));
        if (isNew)
            m_names.push_back(known->first);
        return known->second;
    }

private:
    std::vector<std::string>& m_names;
    std::unordered_map<std::string, std::uint32_t> m_numbers;
};

/// "7", "-1": an index as the file counts, from 1, or back from the last with a minus; as one from
/// 0, or kNoIndex. What is counted forward may come later in the file.
std::int64_t indexOf(std::string_view word, std::size_t count) {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size() || index == 0)
        return kNoIndex;
    if (index > 0)
        return index - 1;
    index += std::int64_t(count);
    return index < 0 ? kNoIndex : index;
}

class Reader {
public:
    explicit Reader(std::string subject) : m_subject(std::move(subject)) {}

    Result<void> read(importers::ByteSource& source, const JobContext& job) {
        constexpr std::size_t kPiece = std::size_t(1) << 20;
        std::string held;
        std::size_t done = 0;
        for (bool end = false; !end;) {
            const std::size_t kept = held.size();
            if (kept > kLongestLine)
                return limit("has a line of more than 16 MB");
            held.resize(kept + kPiece);
            const auto count = source.read({held.data() + kept, kPiece});
            if (!count)
                return tl::unexpected(count.error());
            held.resize(kept + *count);
            end = *count < kPiece;
            done += *count;
            if (auto taken = takeLines(held, end); !taken)
                return taken;
            if (job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            job.progress(
                std::min(1.0, double(done) / double(std::max<std::size_t>(source.size(), 1))));
        }
        return {};
    }

    ObjFile finish() {
        dropBadFaces();
        return std::move(m_file);
    }

private:
    tl::unexpected<Error> limit(const char* what) const {
        return fail(ErrorCode::ResourceLimit, what, m_subject,
                    "Split the model, or export only the part that is needed.");
    }

    /// All whole lines of `held`, at the end of the file the last one too; keeps the rest. A
    /// backslash at the end of a line joins the next to it.
    Result<void> takeLines(std::string& held, bool end) {
        std::size_t begin = 0;
        for (std::size_t from = 0;;) {
            std::size_t stop = held.find('\n', from);
            if (stop == std::string::npos) {
                if (!end || begin == held.size())
                    break;
                stop = held.size();
            }
            const std::size_t last = stop > begin && held[stop - 1] == '\r' ? stop - 1 : stop;
            if (last > begin && held[last - 1] == '\\' && stop < held.size()) {
                std::fill(held.begin() + std::ptrdiff_t(last - 1),
                          held.begin() + std::ptrdiff_t(stop) + 1, ' ');
                from = stop + 1;
                ++m_line;
                continue;
            }
            ++m_line;
            take(std::string_view(held).substr(begin, stop - begin));
            if (m_file.corners.size() > kMost || m_file.vertices.size() > kMost)
                return limit("has more than 200 million corners or vertices");
            begin = from = std::min(stop + 1, held.size());
            if (stop == held.size())
                break;
        }
        held.erase(0, begin);
        return {};
    }

    void take(std::string_view line) {
        const std::string_view word = nextWord(line);
        if (word.empty() || word.front() == '#')
            return;
        if (word == "v")
            takeVertex(line);
        else if (word == "vt")
            takeTexture(line);
        else if (word == "f" || word == "fo")
            takeFace(line);
        else if (word == "o")
            m_object = m_objects(trimmed(line));
        else if (word == "g")
            m_group = m_groups(trimmed(line));
        else if (word == "usemtl")
            m_material = m_materials(trimmed(line));
        else if (word == "mtllib")
            m_file.libraries.emplace_back(trimmed(line).substr(0, kLongestName));
        else if (word == "curv" || word == "curv2" || word == "surf")
            ++m_file.freeForms;
    }

    /// One number alone is legal: v is 0.
    void takeTexture(std::string_view line) {
        const auto u = float(nextNumber(line));
        const std::string_view word = nextWord(line);
        const auto v = float(word.empty() ? 0.0 : numberOf(word));
        m_file.texture.emplace_back(std::isfinite(u) ? u : 0.0F, std::isfinite(v) ? v : 0.0F);
    }

    void takeVertex(std::string_view line) {
        const double x = nextNumber(line), y = nextNumber(line), z = nextNumber(line);
        if (std::isnan(x + y + z))
            ++m_file.unreadable;
        m_file.vertices.emplace_back(x, y, z);
    }

    void takeFace(std::string_view line) {
        ObjFile::Face face{m_object, m_group, m_material, std::uint32_t(m_file.corners.size()),
                           0,        true};
        for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line)) {
            if (word.front() == '#')
                break;
            const std::size_t slash = std::min(word.find('/'), word.size());
            const std::string_view rest = word.substr(std::min(slash + 1, word.size()));
            const std::string_view uv = rest.substr(0, rest.find('/'));
            const std::int64_t v = indexOf(word.substr(0, slash), m_file.vertices.size());
            const std::int64_t t = uv.empty() ? kNoIndex : indexOf(uv, m_file.texture.size());
            m_file.corners.push_back(v < 0 || v >= std::int64_t(kMost) ? kNone : std::uint32_t(v));
            m_file.cornerUvs.push_back(t < 0 || t >= std::int64_t(kMost) ? kNone
                                                                         : std::uint32_t(t));
            ++face.corners;
        }
        m_lines.push_back(m_line);
        m_file.faces.push_back(face);
    }

    /// Only at the end it is known which vertices there are.
    void dropBadFaces() {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < m_file.faces.size(); ++i) {
            ObjFile::Face face = m_file.faces[i];
            const auto* first = m_file.corners.data() + face.firstCorner;
            const bool outOfRange =
                std::any_of(first, first + face.corners,
                            [&](std::uint32_t corner) { return corner >= m_file.vertices.size(); });
            if (outOfRange || face.corners < 3) {
                m_file.faults.push_back({face.object, face.group, m_lines[i], outOfRange});
                continue;
            }
            const auto* uv = m_file.cornerUvs.data() + face.firstCorner;
            face.textured = std::all_of(uv, uv + face.corners, [&](std::uint32_t corner) {
                return corner < m_file.texture.size();
            });
            m_file.faces[kept++] = face;
        }
        m_file.faces.resize(kept);
    }

    std::string m_subject;
    ObjFile m_file;
    NameList m_objects{m_file.objects}, m_groups{m_file.groups}, m_materials{m_file.materials};
    std::uint32_t m_object = 0, m_group = 0, m_material = 0;
    std::size_t m_line = 0;
    std::vector<std::size_t> m_lines;  ///< of the faces
};

}  // namespace

Result<ObjFile> readObj(importers::ByteSource& source, const std::string& subject,
                        const JobContext& job) {
    Reader reader(subject);
    if (auto read = reader.read(source, job); !read)
        return tl::unexpected(read.error());
    return reader.finish();
}

bool looksLikeObjText(std::string_view text, bool named) {
    constexpr std::array<std::string_view, 14> kWords{
        "v", "vt", "vn", "vp", "f", "fo", "o", "g", "s", "l", "p", "usemtl", "mtllib", "usemap"};
    bool vertices = false;
    for (int lines = 0; lines < 200 && !text.empty(); ++lines) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        const bool whole = end != std::string_view::npos;
        text.remove_prefix(whole ? end + 1 : text.size());
        const std::string_view word = nextWord(line);
        if (word.empty() || word.front() == '#' || (!whole && lines > 0))
            continue;
        if (std::find(kWords.begin(), kWords.end(), word) == kWords.end())
            return false;
        vertices = vertices || (word == "v" && !std::isnan(nextNumber(line)));
    }
    return vertices || named;
}

}  // namespace reflet::obj
