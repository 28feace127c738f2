// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace reflet::gltf {

namespace {

/// Elements of an accessor that has no buffer view (all zero) are bounded by this alone.
constexpr std::size_t kMostZeros = 6'000'000;
constexpr std::size_t kLargestStride = 252;  // glTF 2.0, section 5.11.4

enum Component {
    Byte = TINYGLTF_COMPONENT_TYPE_BYTE,
    UByte = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
    Short = TINYGLTF_COMPONENT_TYPE_SHORT,
    UShort = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
    UInt = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
    Float = TINYGLTF_COMPONENT_TYPE_FLOAT
};

std::size_t sizeOf(int component) {
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
float asFloat(const char* at, int component, bool normalized) {
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

std::uint32_t asIndex(const char* at, int component) {
    switch (component) {
        case UByte:
            return load<std::uint8_t>(at);
        case UShort:
            return load<std::uint16_t>(at);
        default:
            return load<std::uint32_t>(at);
    }
}

std::size_t componentsOf(int type) {
    if (type == TINYGLTF_TYPE_SCALAR)
        return 1;
    if (type == TINYGLTF_TYPE_VEC2)
        return 2;
    if (type == TINYGLTF_TYPE_VEC3)
        return 3;
    return type == TINYGLTF_TYPE_VEC4 ? 4 : 0;
}

/// Where the elements of an accessor lie, checked against the buffers.
struct Layout {
    std::size_t count = 0, components = 0, stride = 0;
    int component = 0;
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

std::optional<Layout> layoutOf(const Document& document, int index, std::string& problem) {
    const tinygltf::Accessor* accessor = elementAt(document.model().accessors, index);
    Layout layout;
    if (accessor != nullptr) {
        layout.count = accessor->count;
        layout.component = accessor->componentType;
        layout.components = componentsOf(accessor->type);
        layout.normalized = accessor->normalized;
    }
    const std::size_t size = sizeOf(layout.component) * layout.components;
    const bool zeros = accessor != nullptr && accessor->bufferView < 0;
    if (layout.count == 0 || size == 0 || (zeros && layout.count > kMostZeros)) {
        problem = fmt::format("accessor {} does not exist or cannot be read", index);
        return std::nullopt;
    }
    layout.stride = size;
    if (zeros)
        return layout;
    const auto bytes = document.view(accessor->bufferView);
    if (bytes) {
        const std::size_t stride =
            document.model().bufferViews[std::size_t(accessor->bufferView)].byteStride;
        layout.stride = stride == 0 ? size : stride;
    }
    if (!bytes || layout.stride < size || layout.stride > kLargestStride ||
        !fits(*bytes, accessor->byteOffset, layout.stride, size, layout.count)) {
        problem = fmt::format("accessor {} does not lie within its buffer", index);
        return std::nullopt;
    }
    layout.bytes = bytes->substr(accessor->byteOffset);
    return layout;
}

/// Replaces single elements (glTF 2.0, section 3.6.2.3).
bool applySparse(const Document& document, int index, const Layout& layout,
                 std::vector<float>& values, std::string& problem) {
    const auto& sparse = elementAt(document.model().accessors, index)->sparse;
    if (!sparse.isSparse)
        return true;
    const auto count = std::size_t(std::max(sparse.count, 0));
    const int component = sparse.indices.componentType;
    const auto placeView = document.view(sparse.indices.bufferView);
    const auto valueView = document.view(sparse.values.bufferView);
    const auto placeAt = std::size_t(std::max(sparse.indices.byteOffset, 0));
    const auto valueAt = std::size_t(std::max(sparse.values.byteOffset, 0));
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

std::optional<std::vector<float>> readFloats(const Document& document, int accessor, int components,
                                             std::string& problem) {
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

std::optional<std::vector<std::uint32_t>> readIndices(const Document& document, int accessor,
                                                      std::string& problem) {
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
