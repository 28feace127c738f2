// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/FieldNames.h"

#include <fmt/format.h>

#include <cctype>

namespace reflet::importers {

std::string plainName(std::string_view name) {
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte) != 0)
            out += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    }
    return out;
}

std::optional<std::size_t> firstField(const Fields& fields, Names names) {
    for (const std::string_view name : names) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (plainName(fields[i]) == name)
                return i;
        }
    }
    return std::nullopt;
}

Result<std::optional<std::size_t>> namedField(const Fields& fields, const std::string& name,
                                              const char* option, const std::string& subject) {
    if (name.empty())
        return std::optional<std::size_t>();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i] == name)
            return std::optional(i);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (plainName(fields[i]) == plainName(name))
            return std::optional(i);
    }
    return fail(ErrorCode::Usage, fmt::format("has no attribute \"{}\" ({})", name, option),
                subject, fmt::format("It has {:.400}.", fmt::to_string(fmt::join(fields, ", "))));
}

}  // namespace reflet::importers
