// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/base/JobContext.h"
#include "core/math/Geometry.h"
#include "importers/cityjson/NestedIndices.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace reflet::cityjson {

/// A callable that is borrowed for the time of a call.
template <class Signature>
class Borrowed;
template <class R, class... Args>
class Borrowed<R(Args...)> {
public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, Borrowed>)
        Borrowed(F&& function)  // NOLINT: implicit on purpose, as for std::function
        : m_object(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
          m_call([](void* object, Args... args) -> R {
              return (*static_cast<std::remove_reference_t<F>*>(object))(
                  std::forward<Args>(args)...);
          }) {}
    R operator()(Args... args) const { return m_call(m_object, std::forward<Args>(args)...); }

private:
    void* m_object;
    R (*m_call)(void*, Args...);
};

/// A value met while walking forward through a JSON text. It may be read once, and only before the
/// walk goes on; what is not read is skipped. A reading function that answers nullopt or false has
/// met another kind of value and left it unread.
class JsonValue {
public:
    /// Calls `visit(key, value)` for each member, in the order of the file. False: not an object.
    bool forEachMember(Borrowed<void(std::string_view, JsonValue)> visit);
    /// Calls `visit(value)` for each element. False: not an array.
    bool forEachElement(Borrowed<void(JsonValue)> visit);

    [[nodiscard]] bool isObject();
    [[nodiscard]] bool isArray();
    [[nodiscard]] bool isNull();
    /// A finite number.
    [[nodiscard]] std::optional<double> number();
    /// An integer from 0 to 2^32 - 3.
    [[nodiscard]] std::optional<std::uint32_t> index();
    [[nodiscard]] std::optional<std::string> string();
    /// Numbers and other scalars as they are written, strings without quotes.
    [[nodiscard]] std::string text();

    /// Reads an array of points of `Size` numbers. A point that is not at least `Size` finite
    /// numbers becomes NaN. False: not an array.
    bool points(std::vector<glm::dvec3>& into, const JobContext& job);
    bool points(std::vector<glm::vec2>& into, const JobContext& job);
    /// Reads `depth` levels of arrays with indices in the innermost.
    void nestedIndices(int depth, NestedIndices& into);
    /// The numbers of an array of exactly N; nullopt for anything else.
    template <std::size_t N>
    [[nodiscard]] std::optional<std::array<double, N>> numbers() {
        std::array<double, N> values{};
        if (!numbersInto(values.data(), N))
            return std::nullopt;
        return values;
    }

private:
    friend class JsonDocument;
    friend struct JsonAccess;
    bool numbersInto(double* values, std::size_t count);

    // Holds simdjson's value, which has no name that could be declared without its header.
    alignas(8) std::array<std::byte, 32> m_storage;
    void* m_document = nullptr;
};

/// A JSON text that can be walked from the start any number of times. Memory: the text, four bytes
/// for each of its brackets, commas, colons and scalars, and the strings of the walk under way.
class JsonDocument {
public:
    /// Takes the text over. Unreadable when it is empty or no UTF-8; `subject` names the file.
    [[nodiscard]] static Result<JsonDocument> open(std::string text, std::string subject);

    /// Walks the members of the root object from the start. Unreadable, with line and column, when
    /// the root is no object, or where the text turns out not to be JSON; Cancelled.
    [[nodiscard]] Result<void> walk(const JobContext& job,
                                    Borrowed<void(std::string_view, JsonValue)> visit);
    /// What is wrong with the text as JSON, with line and column, in full: a walk may pass over
    /// faults in what it skips. nullopt when it is sound.
    [[nodiscard]] std::optional<Error> findSyntaxError() const;
    /// After a walk that failed: another object follows the root, as in a JSON text sequence.
    [[nodiscard]] bool isSequence() const;
    /// The part of the text that has been walked through, 0..1.
    [[nodiscard]] double fractionWalked() const;

    JsonDocument(JsonDocument&&) noexcept;
    JsonDocument& operator=(JsonDocument&&) noexcept;
    ~JsonDocument();
    struct Impl;

private:
    explicit JsonDocument(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet::cityjson
