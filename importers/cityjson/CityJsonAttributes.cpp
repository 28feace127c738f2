// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/CityJsonAttributes.h"

#include "importers/cityjsonseq/LineReader.h"
#include "importers/common/ByteSource.h"

#include <simdjson.h>

#include <cctype>
#include <string_view>

namespace reflet {

namespace {

namespace od = simdjson::ondemand;

/// FNV-1a over a JSON text, blanks outside of strings left out.
std::uint64_t hashOf(std::string_view text, std::uint64_t hash) {
    constexpr std::uint64_t kPrime = 0x100000001b3U;
    bool quoted = false, escaped = false;
    for (const char c : text) {
        if (!quoted && std::isspace(static_cast<unsigned char>(c)) != 0)
            continue;
        if (c == '"' && !escaped)
            quoted = !quoted;
        escaped = quoted && c == '\\' && !escaped;
        hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
    }
    return hash;
}

std::uint64_t sumOf(od::object attributes) {
    constexpr std::uint64_t kStart = 0xcbf29ce484222325U;
    std::uint64_t sum = 0;
    for (auto result : attributes) {
        od::field field;
        if (std::move(result).get(field) != simdjson::SUCCESS)
            return sum;
        std::string_view name;
        if (field.unescaped_key().get(name) != simdjson::SUCCESS)
            return sum;
        const std::uint64_t key = hashOf(name, kStart);
        std::string_view value;
        if (simdjson::to_json_string(field.value()).get(value) != simdjson::SUCCESS)
            return sum;
        sum += hashOf(value, key * 31 + 1);
    }
    return sum;
}

void addObjects(od::parser& parser, std::string& text, AttributeHashes& hashes) {
    text.reserve(text.size() + simdjson::SIMDJSON_PADDING);
    od::document document;
    od::object objects;
    if (parser.iterate(text).get(document) != simdjson::SUCCESS ||
        document["CityObjects"].get_object().get(objects) != simdjson::SUCCESS)
        return;
    for (auto result : objects) {
        od::field field;
        std::string_view id;
        if (std::move(result).get(field) != simdjson::SUCCESS ||
            field.unescaped_key().get(id) != simdjson::SUCCESS)
            return;
        const std::string key(id);
        od::object attributes;
        if (field.value()["attributes"].get_object().get(attributes) == simdjson::SUCCESS)
            hashes[key] += sumOf(attributes);
    }
}

}  // namespace

Result<AttributeHashes> cityJsonAttributes(const std::filesystem::path& path, bool lineByLine,
                                           std::size_t limit) {
    auto source = importers::openFile(path, limit);
    if (!source)
        return tl::unexpected<Error>(source.error());
    AttributeHashes hashes;
    od::parser parser;
    if (!lineByLine) {
        auto text = importers::readAll(**source);
        if (!text)
            return tl::unexpected<Error>(text.error());
        if (text->starts_with("\xef\xbb\xbf"))
            text->erase(0, 3);
        addObjects(parser, *text, hashes);
        return hashes;
    }
    cityjsonseq::LineReader lines(**source);
    std::string line;
    for (;;) {
        const auto more = lines.next(line);
        if (!more)
            return tl::unexpected<Error>(more.error());
        if (!*more)
            return hashes;
        addObjects(parser, line, hashes);
    }
}

}  // namespace reflet
