// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/VehicleCache.h"

#include "app/pipeline/ModellingHash.h"
#include "core/base/ContentHash.h"
#include "core/base/Files.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace reflet {

namespace {

static_assert(std::endian::native == std::endian::little, "the file holds numbers as in memory");

constexpr std::string_view kMagic = "ReflVe02";
constexpr std::size_t kHashDigits = 32;
constexpr std::size_t kLargestFile = std::size_t(64) << 20U;
/// Smaller ones are modelled faster than they are read.
constexpr std::size_t kWorthKeeping = 5000;  // triangles

std::string hashOf(std::string_view bytes) {
    return ContentHash().addBytes(std::as_bytes(std::span(bytes))).hex();
}

/// Puts values one after the other; arrays after their count.
class Writer {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(const T& value) { put(&value, sizeof value); }
    template <class T>
    void operator()(const std::vector<T>& values) {
        (*this)(std::uint64_t(values.size()));
        put(values.data(), values.size() * sizeof(T));
    }
    void operator()(const std::string& text) {
        (*this)(std::uint64_t(text.size()));
        put(text.data(), text.size());
    }
    [[nodiscard]] const std::string& bytes() const { return m_bytes; }

private:
    void put(const void* data, std::size_t size) {
        m_bytes.append(static_cast<const char*>(data), size);
    }
    std::string m_bytes;
};

/// Takes them in the same order; counts are never believed beyond the bytes that are there.
class Reader {
public:
    explicit Reader(std::string_view bytes) : m_rest(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(T& value) { take(&value, sizeof value); }
    template <class T>
    void operator()(std::vector<T>& values) {
        values.resize(count(sizeof(T)));
        take(values.data(), values.size() * sizeof(T));
    }
    void operator()(std::string& text) {
        text.resize(count(1));
        take(text.data(), text.size());
    }
    /// How many things follow that take at least so many bytes each.
    [[nodiscard]] std::size_t count(std::size_t least) {
        std::uint64_t number = 0;
        (*this)(number);
        if (number > m_rest.size() / least)
            m_sound = false;
        return m_sound ? std::size_t(number) : 0;
    }
    [[nodiscard]] bool done() const { return m_sound && m_rest.empty(); }

private:
    void take(void* data, std::size_t size) {
        m_sound = m_sound && size <= m_rest.size();
        if (!m_sound || size == 0)
            return;
        std::memcpy(data, m_rest.data(), size);
        m_rest.remove_prefix(size);
    }
    std::string_view m_rest;
    bool m_sound = true;
};

/// Calls use() for every value of a material or body, in the order of the file.
template <class Material, class Use>
void eachOfMaterial(Material& material, Use& use) {
    use(material.name);
    use(material.baseColor);
    use(material.clearCoat);
    use(material.metallic);
    use(material.glass);
    use(material.emission);
}

template <class Body, class Use>
void eachOfBody(Body& body, Use& use) {
    use(body.vertices);
    use(body.normals);
    use(body.triangles);
    use(body.triangleMaterial);
    use(body.center);
    use(body.offset);
    use(body.pivotSpan);
    use(body.pivotMiddle);
    use(body.swing);
    use(body.hinge);
}

/// Whether all indices lead somewhere: the hash says only that they are the ones written.
bool isSound(const VehicleBody& body, std::size_t materials) {
    const auto vertices = body.vertices.size();
    return body.normals.size() == vertices &&
           body.triangleMaterial.size() == body.triangles.size() &&
           std::all_of(body.triangles.begin(), body.triangles.end(),
                       [&](const glm::uvec3& t) {
                           return t.x < vertices && t.y < vertices && t.z < vertices;
                       }) &&
           std::all_of(body.triangleMaterial.begin(), body.triangleMaterial.end(),
                       [&](std::uint16_t material) { return material < materials; });
}

std::string bytesOf(const Vehicle& vehicle) {
    Writer write;
    write(vehicle.name);
    write(vehicle.walks);
    write(std::uint64_t(vehicle.materials.size()));
    for (const VehicleMaterial& material : vehicle.materials)
        eachOfMaterial(material, write);
    write(std::uint64_t(vehicle.bodies.size()));
    for (const VehicleBody& body : vehicle.bodies)
        eachOfBody(body, write);
    return write.bytes();
}

std::optional<Vehicle> vehicleFrom(std::string_view bytes) {
    Vehicle vehicle;
    Reader read(bytes);
    read(vehicle.name);
    read(vehicle.walks);
    vehicle.materials.resize(read.count(sizeof(VehicleMaterial::baseColor)));
    for (VehicleMaterial& material : vehicle.materials)
        eachOfMaterial(material, read);
    vehicle.bodies.resize(read.count(sizeof(VehicleBody::center)));
    for (VehicleBody& body : vehicle.bodies)
        eachOfBody(body, read);
    const bool sound =
        read.done() && !vehicle.bodies.empty() &&
        std::all_of(vehicle.bodies.begin(), vehicle.bodies.end(), [&](const VehicleBody& body) {
            return isSound(body, vehicle.materials.size());
        });
    return sound ? std::optional(std::move(vehicle)) : std::nullopt;
}

}  // namespace

std::filesystem::path VehicleCache::pathOf(const std::string& name) const {
    return m_folder / (ContentHash().add(name).add(kModellingHash).hex() + ".bin");
}

std::optional<Vehicle> VehicleCache::find(const std::string& name) const {
    const auto file = readFile(pathOf(name), kLargestFile);
    const std::size_t head = kMagic.size() + kHashDigits;
    if (!file || file->size() < head || file->compare(0, kMagic.size(), kMagic) != 0)
        return std::nullopt;
    const std::string_view bytes = std::string_view(*file).substr(head);
    if (file->compare(kMagic.size(), kHashDigits, hashOf(bytes)) != 0)
        return std::nullopt;
    return vehicleFrom(bytes);
}

Result<void> VehicleCache::store(const std::string& name, const Vehicle& vehicle) const {
    if (auto made = makeFolder(m_folder); !made)
        return made;
    const std::string bytes = bytesOf(vehicle);
    return writeFileAtomically(pathOf(name), std::string(kMagic) + hashOf(bytes) + bytes);
}

Result<Vehicle> builtInVehicle(const std::string& name, const VehicleCache& cache) {
    if (auto kept = cache.find(name))
        return std::move(*kept);
    auto made = builtInVehicle(name);
    std::size_t triangles = 0;
    for (std::size_t b = 0; made && b < made->bodies.size(); ++b)
        triangles += made->bodies[b].triangles.size();
    if (triangles >= kWorthKeeping)
        static_cast<void>(cache.store(name, *made));
    return made;
}

}  // namespace reflet
