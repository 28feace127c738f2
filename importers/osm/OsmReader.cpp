// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmReader.h"

#include "importers/common/ByteSource.h"
#include "importers/common/GzipSource.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <osmium/io/gzip_compression.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/osm.hpp>
#include <unordered_set>

namespace reflet::osm {

namespace {

constexpr std::size_t kMostNodes = 40'000'000;

osmium::io::File fileOf(const OsmSource& source, bool pbf, bool packed) {
    const std::string format = std::string(pbf ? "pbf" : "xml") + (packed ? ".gz" : "");
    if (!source.bytes.empty())
        return osmium::io::File(source.bytes.data(), source.bytes.size(), format);
    // An absolute name is never taken for an address in the network.
    return osmium::io::File(std::filesystem::absolute(source.path).string(), format);
}

Tags tagsOf(const osmium::OSMObject& object) {
    Tags tags;
    for (const osmium::Tag& tag : object.tags())
        tags.add(tag.key(), tag.value());
    return tags;
}

/// One pass over the file: calls `take` with each object of a kind.
template <class Object, class Take>
Result<void> pass(const osmium::io::File& file, const JobContext& job, const Take& take) {
    osmium::io::Reader reader(file, osmium::osm_entity_bits::from_item_type(Object::itemtype),
                              osmium::io::read_meta::no);
    const auto size = double(std::max<std::size_t>(reader.file_size(), 1));
    while (const osmium::memory::Buffer buffer = reader.read()) {
        for (const Object& object : buffer.template select<Object>()) {
            if (auto taken = take(object); !taken)
                return taken;
        }
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        job.progress(std::min(1.0, double(reader.offset()) / size));
    }
    reader.close();
    return {};
}

class Passes {
public:
    Passes(const osmium::io::File& file, const OsmWanted& wanted, std::string subject)
        : m_file(file), m_wanted(wanted), m_subject(std::move(subject)) {}

    Result<OsmData> run(const JobContext& job) {
        auto relations =
            pass<osmium::Relation>(m_file, job.phase("reading relations", 0.0, 0.3),
                                   [this](const auto& relation) { return take(relation); });
        if (!relations)
            return tl::unexpected(relations.error());
        auto ways = pass<osmium::Way>(m_file, job.phase("reading ways", 0.3, 0.6),
                                      [this](const auto& way) { return take(way); });
        if (!ways)
            return tl::unexpected(ways.error());
        prepareNodes();
        auto nodes = pass<osmium::Node>(m_file, job.phase("reading nodes", 0.6, 1.0),
                                        [this](const auto& node) { return take(node); });
        if (!nodes)
            return tl::unexpected(nodes.error());
        return std::move(m_data);
    }

private:
    Result<void> take(const osmium::Relation& source) {
        Relation relation;
        relation.tags = tagsOf(source);
        if (!m_wanted.relation(relation.tags))
            return {};
        relation.id = source.id();
        for (const osmium::RelationMember& member : source.members()) {
            if (member.type() == osmium::item_type::node)
                continue;
            const bool isRelation = member.type() == osmium::item_type::relation;
            relation.members.push_back({member.ref(), isRelation, member.role()});
            if (!isRelation)
                m_members.insert(member.ref());
        }
        m_data.relations.push_back(std::move(relation));
        return {};
    }

    Result<void> take(const osmium::Way& source) {
        Way way;
        way.tags = tagsOf(source);
        if (!m_members.contains(source.id()) && !m_wanted.way(way.tags))
            return {};
        way.id = source.id();
        if (!m_data.wayIndex.emplace(way.id, m_data.ways.size()).second)
            return {};  // an older version of a way that is there already
        for (const osmium::NodeRef& node : source.nodes())
            way.nodes.push_back(node.ref());
        m_kept += way.nodes.size();
        if (m_kept > kMostNodes)
            return fail(ErrorCode::ResourceLimit, "has more than 40 million points to keep",
                        m_subject, "Cut out the part that you need, e.g. with osmium extract.");
        m_data.ways.push_back(std::move(way));
        return {};
    }

    Result<void> keep(const osmium::Node& source) {
        constexpr std::size_t kMostKept = 4'000'000;
        Node node{source.id(), tagsOf(source), std::nullopt};
        if (!m_wanted.node(node.tags))
            return {};
        if (m_data.nodes.size() >= kMostKept)
            return fail(ErrorCode::ResourceLimit, "has more than 4 million trees", m_subject,
                        "Cut out the part that you need, e.g. with osmium extract.");
        if (source.location().valid())
            node.place = glm::dvec2(source.location().lon(), source.location().lat());
        m_data.nodes.push_back(std::move(node));
        return {};
    }

    void prepareNodes() {
        std::vector<std::int64_t>& ids = m_data.nodeIds;
        ids.reserve(m_kept);
        for (const Way& way : m_data.ways)
            ids.insert(ids.end(), way.nodes.begin(), way.nodes.end());
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        m_data.nodePlaces.assign(ids.size(), {OsmData::kNowhere, OsmData::kNowhere});
    }

    Result<void> take(const osmium::Node& node) {
        if (m_wanted.node != nullptr && !node.tags().empty()) {
            if (auto kept = keep(node); !kept)
                return kept;
        }
        const std::vector<std::int64_t>& ids = m_data.nodeIds;
        const auto found = std::lower_bound(ids.begin(), ids.end(), node.id());
        if (found != ids.end() && *found == node.id() && node.location().valid()) {
            m_data.nodePlaces[std::size_t(found - ids.begin())] = {node.location().x(),
                                                                   node.location().y()};
        }
        return {};
    }

    const osmium::io::File& m_file;
    const OsmWanted& m_wanted;
    std::string m_subject;
    OsmData m_data;
    std::unordered_set<std::int64_t> m_members;
    std::size_t m_kept = 0;
};

/// The beginning of a file, unpacked.
struct Head {
    std::string bytes;
    bool packed = false;  ///< with gzip
};

Result<std::string> unpacked(const std::filesystem::path& path) {
    constexpr std::size_t kMost = std::size_t(1) << 30;
    auto file = importers::openFile(path, kMost);
    if (!file)
        return tl::unexpected(file.error());
    return importers::readAll(**file);
}

Result<Head> headOf(const OsmSource& source) {
    constexpr std::size_t kHead = 1024;
    if (!source.bytes.empty())
        return Head{std::string(source.bytes.substr(0, kHead))};
    Head head{std::string(kHead, '\0')};
    auto raw = InputFile::open(source.path);
    if (!raw)
        return tl::unexpected(raw.error());
    if (const auto start = raw->read(head.bytes); start)
        head.packed = importers::looksLikeGzip(std::string_view(head.bytes).substr(0, *start));
    const auto file = importers::openFile(source.path, std::numeric_limits<std::size_t>::max());
    if (!file)
        return tl::unexpected(file.error());
    const auto count = (*file)->read(head.bytes);
    if (!count)
        return tl::unexpected(count.error());
    if (*count == 0)
        return fail(ErrorCode::Unreadable, "is empty", source.path.string(),
                    "Download the extract again.");
    head.bytes.resize(*count);
    return head;
}

}  // namespace

std::optional<glm::dvec2> OsmData::place(std::int64_t node) const {
    const auto found = std::lower_bound(nodeIds.begin(), nodeIds.end(), node);
    if (found == nodeIds.end() || *found != node)
        return std::nullopt;
    const auto [x, y] = nodePlaces[std::size_t(found - nodeIds.begin())];
    if (x == kNowhere)
        return std::nullopt;
    constexpr double kPerDegree = 1e7;
    return glm::dvec2(double(x) / kPerDegree, double(y) / kPerDegree);
}

bool looksLikeOsmXml(std::string_view head) {
    return head.find("<osm") != std::string_view::npos &&
           head.find("<osmChange") == std::string_view::npos;
}

bool looksLikeOsmPbf(std::string_view head) {
    // The length of the first blob's header, then that: field 1, nine bytes.
    constexpr std::size_t kLength = 4;
    return head.size() > kLength && head.substr(kLength).starts_with("\x0a\x09OSMHeader");
}

Result<OsmData> readOsm(const OsmSource& source, const OsmWanted& wanted, const JobContext& job) {
    const auto head = headOf(source);
    if (!head)
        return tl::unexpected(head.error());
    const std::string subject = source.path.string();
    const bool pbf = looksLikeOsmPbf(head->bytes);
    if (pbf && head->packed) {
        // libosmium reads PBF from the file itself, past its own unpacking.
        const auto bytes = unpacked(source.path);
        if (!bytes)
            return tl::unexpected(bytes.error());
        return readOsm({source.path, *bytes}, wanted, job);
    }
    try {
        return Passes(fileOf(source, pbf, head->packed), wanted, subject).run(job);
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable,
                    std::string("cannot be read as OpenStreetMap data: ") + error.what(), subject,
                    "Download the extract again, or check it with osmium fileinfo.");
    }
}

}  // namespace reflet::osm
