// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace reflet::gltf {

using nlohmann::json;

namespace {

/// Elements of an accessor that has no buffer view (all zero) are bounded by this alone.
constexpr std::size_t kMostElements = 24'000'000;

enum Component {
    Byte = 5120,
    UByte = 5121,
    Short = 5122,
    UShort = 5123,
    UInt = 5125,
    Float = 5126
};

std::size_t sizeOf(std::size_t component) {
    switch (component) {
        case Byte:
        case UByte:
            return 1;
        case Short:
        case UShort:
            return 2;
        case UInt:
        case Float:
            return 4;
        default:
            return 0;
    }
}

template <class T>
T load(const char* at) {
    T value{};
    std::memcpy(&value, at, sizeof(T));
    return value;
}

/// glTF 2.0, section 3.6.2.2: normalised integers.
float asFloat(const char* at, std::size_t component, bool normalized) {
    switch (component) {
        case Byte: {
            const auto v = float(load<std::int8_t>(at));
            return normalized ? std::max(v / 127.0F, -1.0F) : v;
        }
        case UByte: {
            const auto v = float(load<std::uint8_t>(at));
            return normalized ? v / 255.0F : v;
        }
        case Short: {
            const auto v = float(load<std::int16_t>(at));
            return normalized ? std::max(v / 32767.0F, -1.0F) : v;
        }
        case UShort: {
            const auto v = float(load<std::uint16_t>(at));
            return normalized ? v / 65535.0F : v;
        }
        case UInt:
            return float(load<std::uint32_t>(at));
        default:
            return load<float>(at);
    }
}

std::uint32_t asIndex(const char* at, std::size_t component) {
    switch (component) {
        case UByte:
            return load<std::uint8_t>(at);
        case UShort:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

std::size_t componentsOf(const std::string& type) {
    if (type == "SCALAR")
        return 1;
    if (type == "VEC2")
        return 2;
    if (type == "VEC3")
        return 3;
    return type == "VEC4" ? 4 : 0;
}

/// Where the elements of an accessor lie, checked against the buffers.
struct Layout {
    std::size_t count = 0, components = 0, component = 0, stride = 0;
    bool normalized = false;
    std::string_view bytes;  // from the first element on; empty: all zero
};

/// `count` elements of `size` bytes from `offset` on, `stride` apart, lie within the view.
bool fits(std::string_view bytes, std::size_t offset, std::size_t stride, std::size_t size,
          std::size_t count) {
    if (count == 0)
        return true;
    if (offset > bytes.size() || size > bytes.size() - offset)
        return false;
    return (bytes.size() - offset - size) / stride >= count - 1;
}

std::optional<Layout> layoutOf(const Document& document, std::size_t index, std::string& problem) {
    const json& accessor = document.element("accessors", index);
    Layout layout;
    const auto count = wholeNumber(accessor, "count");
    layout.component = wholeNumber(accessor, "componentType").value_or(0);
    layout.components = componentsOf(text(accessor, "type"));
    layout.normalized = member(accessor, "normalized") == json(true);
    const std::size_t size = sizeOf(layout.component) * layout.components;
    if (!count || *count == 0 || *count > kMostElements || size == 0) {
        problem = fmt::format("accessor {} does not exist or cannot be read", index);
        return std::nullopt;
    }
    layout.count = *count;
    layout.stride = size;
    const auto view = wholeNumber(accessor, "bufferView");
    if (!view)
        return layout;
    const auto bytes = document.view(*view);
    const std::size_t stride =
        wholeNumber(document.element("bufferViews", *view), "byteStride").value_or(0);
    layout.stride = stride == 0 ? size : stride;
    const std::size_t offset = wholeNumber(accessor, "byteOffset").value_or(0);
    if (!bytes || layout.stride < size || layout.stride > 4096 ||
        !fits(*bytes, offset, layout.stride, size, layout.count)) {
        problem = fmt::format("accessor {} does not lie within its buffer", index);
        return std::nullopt;
    }
    layout.bytes = bytes->substr(offset);
    return layout;
}

/// Replaces single elements (glTF 2.0, section 3.6.2.3).
bool applySparse(const Document& document, std::size_t index, const Layout& layout,
                 std::vector<float>& values, std::string& problem) {
    const json& sparse = member(document.element("accessors", index), "sparse");
    if (!sparse.is_object())
        return true;
    const std::size_t count = wholeNumber(sparse, "count").value_or(0);
    const json& places = member(sparse, "indices");
    const json& given = member(sparse, "values");
    const std::size_t component = wholeNumber(places, "componentType").value_or(0);
    const auto placeView = document.view(wholeNumber(places, "bufferView").value_or(SIZE_MAX));
    const auto valueView = document.view(wholeNumber(given, "bufferView").value_or(SIZE_MAX));
    const std::size_t placeAt = wholeNumber(places, "byteOffset").value_or(0);
    const std::size_t valueAt = wholeNumber(given, "byteOffset").value_or(0);
    const std::size_t size = sizeOf(layout.component) * layout.components;
    if (count > layout.count || sizeOf(component) == 0 || !placeView || !valueView ||
        !fits(*placeView, placeAt, sizeOf(component), sizeOf(component), count) ||
        !fits(*valueView, valueAt, size, size, count)) {
        problem = fmt::format("the sparse part of accessor {} does not fit", index);
        return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place =
            asIndex(placeView->data() + placeAt + i * sizeOf(component), component);
        if (place >= layout.count) {
            problem = fmt::format("the sparse part of accessor {} is out of range", index);
            return false;
        }
        for (std::size_t c = 0; c < layout.components; ++c) {
            values[place * layout.components + c] =
                asFloat(valueView->data() + valueAt + i * size + c * sizeOf(layout.component),
                        layout.component, layout.normalized);
        }
    }
    return true;
}

}  // namespace

std::optional<std::vector<float>> readFloats(const Document& document, std::size_t accessor,
                                             int components, std::string& problem) {
    const auto layout = layoutOf(document, accessor, problem);
    if (!layout)
        return std::nullopt;
    if (layout->components != std::size_t(components)) {
        problem = fmt::format("accessor {} is of another type", accessor);
        return std::nullopt;
    }
    std::vector<float> values(layout->count * layout->components, 0.0F);
    for (std::size_t i = 0; i < layout->count && !layout->bytes.empty(); ++i) {
        const char* at = layout->bytes.data() + i * layout->stride;
        for (std::size_t c = 0; c < layout->components; ++c) {
            values[i * layout->components + c] =
                asFloat(at + c * sizeOf(layout->component), layout->component, layout->normalized);
        }
    }
    if (!applySparse(document, accessor, *layout, values, problem))
        return std::nullopt;
    return values;
}

std::optional<std::vector<std::uint32_t>> readIndices(const Document& document,
                                                      std::size_t accessor, std::string& problem) {
    const auto layout = layoutOf(document, accessor, problem);
    if (!layout)
        return std::nullopt;
    if (layout->components != 1 || layout->component == Float || layout->component == Byte ||
        layout->component == Short) {
        problem = fmt::format("accessor {} holds no indices", accessor);
        return std::nullopt;
    }
    std::vector<std::uint32_t> values(layout->count, 0);
    for (std::size_t i = 0; i < layout->count && !layout->bytes.empty(); ++i)
        values[i] = asIndex(layout->bytes.data() + i * layout->stride, layout->component);
    return values;
}

}  // namespace reflet::gltf
