// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/JsonDocument.h"

#include "importers/cityjson/JsonPlace.h"

#include <fmt/core.h>
#include <simdjson.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

namespace reflet::cityjson {

namespace od = simdjson::ondemand;

struct JsonDocument::Impl {
    std::string text;  // with simdjson::SIMDJSON_PADDING bytes reserved behind it
    std::string subject;
    od::parser parser;
    od::document document;
    std::size_t furthest = 0;  // offset of the last member met
    bool broken = false;       // the text is no JSON
    std::size_t brokenAt = 0;
    bool anotherBehind = false;  // an object follows the root

    /// Marks the text as broken where the walk stands.
    void fail() {
        if (std::exchange(broken, true))
            return;
        const char* at = nullptr;
        if (document.current_location().get(at) != simdjson::SUCCESS)
            at = text.data() + text.size();
        brokenAt = static_cast<std::size_t>(at - text.data());
    }
    [[nodiscard]] Error syntaxError() const { return syntaxError(whyNotJson(text)); }
    [[nodiscard]] Error syntaxError(std::string why) const;
};

/// The way from a JsonValue to the value of simdjson in it.
struct JsonAccess {
    static JsonValue wrap(const od::value& value, JsonDocument::Impl& document) {
        static_assert(sizeof(od::value) <= sizeof(JsonValue::m_storage));
        static_assert(alignof(od::value) <= 8 && std::is_trivially_destructible_v<od::value>);
        JsonValue wrapped;
        new (wrapped.m_storage.data()) od::value(value);
        wrapped.m_document = &document;
        return wrapped;
    }
    static od::value& value(JsonValue& wrapped) {
        return *std::launder(reinterpret_cast<od::value*>(wrapped.m_storage.data()));
    }
    static JsonDocument::Impl& document(JsonValue& wrapped) {
        return *static_cast<JsonDocument::Impl*>(wrapped.m_document);
    }
};

Error JsonDocument::Impl::syntaxError(std::string why) const {
    if (why.empty())
        why = placeOf(text, brokenAt) + ": nested too deeply or not as JSON allows";
    return {ErrorCode::Unreadable,
            "is no valid JSON at " + why,
            subject,
            "The file is damaged or was cut short: get it again, or check it with a JSON "
            "validator.",
            {}};
}

// ---- values ----

namespace {

/// The members of an object of simdjson; false when the text breaks.
template <class Object>
bool visitMembers(Object& object, JsonDocument::Impl& document,
                  const Borrowed<void(std::string_view, JsonValue)>& visit) {
    for (auto result : object) {
        od::field field;
        if (std::move(result).get(field) != simdjson::SUCCESS) {
            document.fail();
            return false;
        }
        document.furthest = static_cast<std::size_t>(
            reinterpret_cast<const char*>(field.key().raw()) - document.text.data());
        std::string_view key;
        if (field.unescaped_key().get(key) != simdjson::SUCCESS)
            key = "\xEF\xBF\xBD";  // a key that cannot be decoded is known to nobody
        visit(key, JsonAccess::wrap(field.value(), document));
        if (document.broken)
            return false;
    }
    return true;
}

}  // namespace

bool JsonValue::isObject() {
    od::json_type type{};
    return JsonAccess::value(*this).type().get(type) == simdjson::SUCCESS &&
           type == od::json_type::object;
}

bool JsonValue::isArray() {
    od::json_type type{};
    return JsonAccess::value(*this).type().get(type) == simdjson::SUCCESS &&
           type == od::json_type::array;
}

bool JsonValue::isNull() {
    od::json_type type{};
    return JsonAccess::value(*this).type().get(type) == simdjson::SUCCESS &&
           type == od::json_type::null;
}

bool JsonValue::forEachMember(Borrowed<void(std::string_view, JsonValue)> visit) {
    if (!isObject())
        return false;
    JsonDocument::Impl& document = JsonAccess::document(*this);
    od::object object;
    if (JsonAccess::value(*this).get_object().get(object) != simdjson::SUCCESS) {
        document.fail();
        return true;
    }
    visitMembers(object, document, visit);
    return true;
}

bool JsonValue::forEachElement(Borrowed<void(JsonValue)> visit) {
    if (!isArray())
        return false;
    JsonDocument::Impl& document = JsonAccess::document(*this);
    od::array array;
    if (JsonAccess::value(*this).get_array().get(array) != simdjson::SUCCESS) {
        document.fail();
        return true;
    }
    for (auto result : array) {
        od::value element;
        if (std::move(result).get(element) != simdjson::SUCCESS) {
            document.fail();
            return true;
        }
        visit(JsonAccess::wrap(element, document));
        if (document.broken)
            return true;
    }
    return true;
}

std::optional<double> JsonValue::number() {
    double value = 0.0;
    if (JsonAccess::value(*this).get_double().get(value) != simdjson::SUCCESS ||
        !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<std::uint32_t> JsonValue::index() {
    std::uint64_t value = 0;
    if (JsonAccess::value(*this).get_uint64().get(value) != simdjson::SUCCESS ||
        value >= kNullIndex)
        return std::nullopt;
    return static_cast<std::uint32_t>(value);
}

std::optional<std::string> JsonValue::string() {
    std::string_view value;
    if (JsonAccess::value(*this).get_string().get(value) != simdjson::SUCCESS)
        return std::nullopt;
    return std::string(value);
}

std::string JsonValue::text() {
    if (auto text = string())
        return *text;
    if (isObject())
        return "{...}";
    if (isArray())
        return "[...]";
    std::string_view token = JsonAccess::value(*this).raw_json_token();
    while (!token.empty() && (token.back() == ' ' || token.back() == '\n' || token.back() == '\r' ||
                              token.back() == '\t'))
        token.remove_suffix(1);
    constexpr std::size_t kLongest = 60;
    std::string shown(token.substr(0, kLongest));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
    return shown;
}

// ---- bulk reading: a city has millions of these, so they stay within this file ----

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPollEvery = 1U << 14;

/// Reads up to `Size` numbers of an array. False when the text breaks. Elements beyond are left.
template <std::size_t Size>
bool readPoint(od::value& value, std::array<double, Size>& point) {
    point.fill(kNaN);
    od::json_type type{};
    if (value.type().get(type) != simdjson::SUCCESS || type != od::json_type::array)
        return true;
    od::array array;
    if (value.get_array().get(array) != simdjson::SUCCESS)
        return false;
    std::size_t i = 0;
    for (auto result : array) {
        od::value element;
        if (std::move(result).get(element) != simdjson::SUCCESS)
            return false;
        double number = kNaN;
        if (i < Size && element.get_double().get(number) == simdjson::SUCCESS)
            point[i] = number;
        ++i;
    }
    return true;
}

template <std::size_t Size, class Point>
bool readPoints(od::value& value, JsonDocument::Impl& document, const JobContext& job,
                std::vector<Point>& into) {
    od::array array;
    if (value.get_array().get(array) != simdjson::SUCCESS) {
        document.fail();
        return true;
    }
    std::array<double, Size> numbers{};
    for (auto result : array) {
        od::value element;
        if (std::move(result).get(element) != simdjson::SUCCESS || !readPoint(element, numbers)) {
            document.fail();
            return true;
        }
        Point point{};
        bool finite = true;
        for (std::size_t i = 0; i < Size; ++i)
            finite = finite && std::isfinite(numbers[i]);
        for (std::size_t i = 0; i < Size; ++i)
            point[static_cast<glm::length_t>(i)] =
                static_cast<typename Point::value_type>(finite ? numbers[i] : kNaN);
        into.push_back(point);
        if (into.size() % kPollEvery == 0 && job.cancelled())
            return true;
    }
    return true;
}

/// False when the text breaks.
bool readNested(od::value& value, int level, NestedIndices& into) {
    const bool innermost = level + 1 == into.depth;
    auto& counts = into.counts[static_cast<std::size_t>(level)];
    od::json_type type{};
    if (value.type().get(type) != simdjson::SUCCESS || type != od::json_type::array) {
        if (type == od::json_type::null)
            into.hasNullArray = true;
        else
            into.malformed = true;
        counts.push_back(NestedIndices::kNullArray);
        return true;
    }
    od::array array;
    if (value.get_array().get(array) != simdjson::SUCCESS)
        return false;
    const std::size_t slot = counts.size();
    counts.push_back(0);
    std::uint32_t children = 0;
    for (auto result : array) {
        od::value element;
        if (std::move(result).get(element) != simdjson::SUCCESS)
            return false;
        ++children;
        if (!innermost) {
            if (!readNested(element, level + 1, into))
                return false;
            continue;
        }
        std::uint64_t index = 0;
        if (element.get_uint64().get(index) == simdjson::SUCCESS) {
            into.leaves.push_back(index < kNullIndex ? static_cast<std::uint32_t>(index)
                                                     : kBadIndex);
            continue;
        }
        od::json_type kind{};
        const bool known = element.type().get(kind) == simdjson::SUCCESS;
        into.malformed = into.malformed || !known || kind == od::json_type::array ||
                         kind == od::json_type::object;
        into.leaves.push_back(known && kind == od::json_type::null ? kNullIndex : kBadIndex);
    }
    counts[slot] = children;
    return true;
}

}  // namespace

bool JsonValue::points(std::vector<glm::dvec3>& into, const JobContext& job) {
    return isArray() &&
           readPoints<3>(JsonAccess::value(*this), JsonAccess::document(*this), job, into);
}

bool JsonValue::points(std::vector<glm::vec2>& into, const JobContext& job) {
    return isArray() &&
           readPoints<2>(JsonAccess::value(*this), JsonAccess::document(*this), job, into);
}

void JsonValue::nestedIndices(int depth, NestedIndices& into) {
    into.clear();
    into.depth = depth;
    if (!readNested(JsonAccess::value(*this), 0, into))
        JsonAccess::document(*this).fail();
}

bool JsonValue::numbersInto(double* values, std::size_t count) {
    std::size_t read = 0;
    bool good = true;
    const bool isList = forEachElement([&](JsonValue element) {
        const auto number = element.number();
        if (read < count && number)
            values[read] = *number;
        else
            good = false;
        ++read;
    });
    return isList && good && read == count;
}

// ---- the document ----

JsonDocument::JsonDocument(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

Result<JsonDocument> JsonDocument::open(std::string text, std::string subject) {
    auto impl = std::make_unique<Impl>();
    impl->text = std::move(text);
    impl->subject = std::move(subject);
    if (impl->text.find_first_not_of(" \t\r\n") == std::string::npos) {
        return fail(ErrorCode::Unreadable, "is empty", impl->subject,
                    "Get the file again: nothing of it arrived.");
    }
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (impl->text.starts_with(kByteOrderMark))
        impl->text.replace(0, kByteOrderMark.size(), kByteOrderMark.size(), ' ');
    impl->text.reserve(impl->text.size() + simdjson::SIMDJSON_PADDING);
    const simdjson::padded_string_view padded(impl->text.data(), impl->text.size(),
                                              impl->text.size() + simdjson::SIMDJSON_PADDING);
    const simdjson::error_code error = impl->parser.iterate(padded).get(impl->document);
    if (error == simdjson::CAPACITY) {
        return fail(ErrorCode::ResourceLimit, "is larger than the 4 GB that can be read at once",
                    impl->subject, "Split it into tiles.");
    }
    if (error == simdjson::MEMALLOC) {
        return fail(ErrorCode::ResourceLimit, "does not fit into the memory", impl->subject,
                    "Split it into tiles.");
    }
    if (error != simdjson::SUCCESS)
        return tl::unexpected<Error>(impl->syntaxError());
    return JsonDocument(std::move(impl));
}

Result<void> JsonDocument::walk(const JobContext& job,
                                Borrowed<void(std::string_view, JsonValue)> visit) {
    Impl& impl = *m_impl;
    impl.document.rewind();
    impl.furthest = 0;
    od::json_type type{};
    if (impl.document.type().get(type) == simdjson::SUCCESS && type != od::json_type::object) {
        if (auto broken = findSyntaxError())
            return tl::unexpected<Error>(*std::move(broken));
        return fail(ErrorCode::Unreadable, "is no CityJSON: its root is not an object",
                    impl.subject, "Check that this is the right file.");
    }
    od::object object;
    if (impl.document.get_object().get(object) != simdjson::SUCCESS) {
        impl.fail();
        return tl::unexpected<Error>(impl.syntaxError());
    }
    visitMembers(object, impl, visit);
    if (job.cancelled())
        return tl::unexpected<Error>(JobContext::cancelledError());
    const char* behind = nullptr;
    if (!impl.broken && impl.document.current_location().get(behind) == simdjson::SUCCESS) {
        impl.anotherBehind = *behind == '{';
        impl.fail();
    }
    if (impl.broken)
        return tl::unexpected<Error>(impl.syntaxError());
    return {};
}

bool JsonDocument::isSequence() const {
    return m_impl->anotherBehind;
}

std::optional<Error> JsonDocument::findSyntaxError() const {
    const std::string why = whyNotJson(m_impl->text);
    return why.empty() ? std::nullopt : std::optional(m_impl->syntaxError(why));
}

double JsonDocument::fractionWalked() const {
    return static_cast<double>(m_impl->furthest) / static_cast<double>(m_impl->text.size());
}

}  // namespace reflet::cityjson
