// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfPaint.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace reflet::gltf {

namespace {

constexpr float kSameColor = 0.09F;    // distance in display values that counts as one colour
constexpr float kMergeColor = 0.055F;  // and below which two colours of a palette become one
constexpr int kBins = 32;              // of a colour channel
constexpr int kMostSteps = 12;         // samples along the edge of a triangle
constexpr float kTexelsPerStep = 6.0F;
constexpr float kEmissiveLimit = 8.0F;

glm::vec3 display(const glm::vec3& linear) {
    return glm::pow(glm::clamp(linear, 0.0F, 1.0F), glm::vec3(1.0F / 2.2F));
}

TextureUse readTexture(const tinygltf::TextureInfo& info, Images* images) {
    TextureUse use;
    if (info.index < 0)
        return use;
    use.texture = info.index;
    use.image = images != nullptr ? images->ofTexture(info.index) : nullptr;
    use.set = info.texCoord;
    const tinygltf::Value& transform = extensionOf(info.extensions, "KHR_texture_transform");
    if (const auto offset = numbers(transform, "offset"); offset.size() == 2)
        use.offset = {float(offset[0]), float(offset[1])};
    if (const auto scale = numbers(transform, "scale"); scale.size() == 2)
        use.scale = {float(scale[0]), float(scale[1])};
    use.rotation = float(number(transform, "rotation", 0.0));
    if (const int set = indexIn(transform, "texCoord"); set >= 0)
        use.set = set;
    return use;
}

/// A texture of an extension, which tinygltf leaves as it is.
tinygltf::TextureInfo textureIn(const tinygltf::Value& object, const char* key) {
    const tinygltf::Value& value = member(object, key);
    tinygltf::TextureInfo info;
    info.index = indexIn(value, "index");
    info.texCoord = std::max(indexIn(value, "texCoord"), 0);
    if (const tinygltf::Value& extensions = member(value, "extensions"); extensions.IsObject())
        info.extensions = extensions.Get<tinygltf::Value::Object>();
    return info;
}

float unit(double value) {
    return float(std::clamp(value, 0.0, 1.0));
}

/// Linear, from three or more values.
glm::vec3 colorOf(const std::vector<double>& values, glm::vec3 fallback) {
    if (values.size() < 3)
        return fallback;
    glm::vec3 out(0.0F);
    for (int i = 0; i < 3; ++i)
        out[i] = float(std::clamp(values[std::size_t(i)], 0.0, 1e4));
    return out;
}

/// What the two ways to describe a surface say alike.
struct Base {
    std::vector<double> factor;
    tinygltf::TextureInfo texture;
};

/// pbrMetallicRoughness, or KHR_materials_pbrSpecularGlossiness where the file has that alone.
Base readBase(const tinygltf::Material& source, GltfMaterial& out) {
    const tinygltf::Value& gloss =
        extensionOf(source.extensions, "KHR_materials_pbrSpecularGlossiness");
    if (gloss.IsObject() && source.values.empty()) {
        out.metallic = 0.0F;
        out.roughness = 1.0F - unit(number(gloss, "glossinessFactor", 1.0));
        return {numbers(gloss, "diffuseFactor"), textureIn(gloss, "diffuseTexture")};
    }
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    out.metallic = unit(pbr.metallicFactor);
    out.roughness = unit(pbr.roughnessFactor);
    return {pbr.baseColorFactor, pbr.baseColorTexture};
}

struct Corner {
    glm::vec3 position{0.0F}, normal{0.0F};
    glm::vec2 uv{0.0F};
    glm::vec3 tint{1.0F};
};

Corner middle(const Corner& a, const Corner& b) {
    return {0.5F * (a.position + b.position), 0.5F * (a.normal + b.normal), 0.5F * (a.uv + b.uv),
            0.5F * (a.tint + b.tint)};
}

/// Mean colour of a triangle, and whether it is of one colour.
struct Sampled {
    glm::vec3 mean{0.0F};
    bool even = true;
};

class Painter {
public:
    Painter(const Look& look, float finest, std::size_t budget, PaintedMesh& out)
        : m_look(look), m_finest(finest), m_budget(budget), m_out(out) {}

    void paint(const Corner& a, const Corner& b, const Corner& c) {
        const Sampled seen = sample(a, b, c);
        const float longest =
            std::max({glm::distance(a.position, b.position), glm::distance(b.position, c.position),
                      glm::distance(c.position, a.position)});
        if (seen.even || longest <= m_finest || m_out.mesh.triangles.size() >= m_budget) {
            emit(a, b, c, seen.mean);
            return;
        }
        const Corner ab = middle(a, b);
        const Corner bc = middle(b, c);
        const Corner ca = middle(c, a);
        paint(a, ab, ca);
        paint(ab, b, bc);
        paint(ca, bc, c);
        paint(ab, bc, ca);
    }

private:
    [[nodiscard]] Sampled sample(const Corner& a, const Corner& b, const Corner& c) const {
        const Image& image = *m_look.base.image;
        const glm::vec2 size(float(image.width), float(image.height));
        const glm::vec2 u = m_look.base.at(a.uv);
        const glm::vec2 v = m_look.base.at(b.uv);
        const glm::vec2 w = m_look.base.at(c.uv);
        const float texels = std::max({glm::length((v - u) * size), glm::length((w - v) * size),
                                       glm::length((u - w) * size)});
        // The largest first: `texels` may be infinite or no number at all.
        const float wanted = std::min(float(kMostSteps), texels / kTexelsPerStep + 2.0F);
        const int steps = wanted >= 2.0F ? int(wanted) : 2;
        Sampled out;
        glm::vec3 low(1e9F);
        glm::vec3 high(-1e9F);
        int count = 0;
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j + i < steps; ++j) {
                // Inside the triangle, so that a seam of the texture does not show.
                const float s = (float(i) + 1.0F / 3.0F) / float(steps);
                const float t = (float(j) + 1.0F / 3.0F) / float(steps);
                const glm::vec2 at = u + (v - u) * s + (w - u) * t;
                const glm::vec3 color = image.sample(at.x, at.y);
                low = glm::min(low, display(color));
                high = glm::max(high, display(color));
                out.mean += color;
                ++count;
            }
        }
        out.mean = out.mean / float(count) * (a.tint + b.tint + c.tint) / 3.0F;
        out.even = glm::length(high - low) < kSameColor;
        return out;
    }

    void emit(const Corner& a, const Corner& b, const Corner& c, const glm::vec3& color) {
        const auto base = std::uint32_t(m_out.mesh.positions.size());
        for (const Corner* corner : {&a, &b, &c}) {
            m_out.mesh.positions.push_back(corner->position);
            const float length = glm::length(corner->normal);
            m_out.mesh.normals.push_back(length > 1e-6F ? corner->normal / length
                                                        : glm::vec3(0, 1, 0));
        }
        m_out.mesh.triangles.emplace_back(base, base + 1, base + 2);
        m_out.color.push_back(color);
    }

    const Look& m_look;
    const float m_finest;
    const std::size_t m_budget;
    PaintedMesh& m_out;
};

}  // namespace

glm::vec2 TextureUse::at(const glm::vec2& uv) const {
    const glm::vec2 scaled = uv * scale;
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    return offset + glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

Look readLook(const tinygltf::Material& source, int index, Images* images) {
    Look look;
    GltfMaterial& m = look.material;
    m.name = source.name.empty() ? "material " + std::to_string(index) : source.name;
    const Base base = readBase(source, m);
    m.color = glm::min(colorOf(base.factor, glm::vec3(1.0F)), glm::vec3(1.0F));
    if (source.alphaMode == "BLEND" && base.factor.size() == 4)
        m.alpha = unit(base.factor[3]);
    const auto factor = [&](const char* extension, const char* key, double fallback) {
        return number(extensionOf(source.extensions, extension), key, fallback);
    };
    m.clearCoat = unit(factor("KHR_materials_clearcoat", "clearcoatFactor", 0.0));
    m.transmission = unit(factor("KHR_materials_transmission", "transmissionFactor", 0.0));
    const double strength = factor("KHR_materials_emissive_strength", "emissiveStrength", 1.0);
    m.emission = glm::min(
        colorOf(source.emissiveFactor, glm::vec3(0.0F)) * float(std::clamp(strength, 0.0, 1e3)),
        glm::vec3(kEmissiveLimit));
    m.doubleSided = source.doubleSided;
    look.base = readTexture(base.texture, images);
    look.metallicRoughness =
        readTexture(source.pbrMetallicRoughness.metallicRoughnessTexture, images);
    look.emissive = readTexture(source.emissiveTexture, images);
    m.textured = look.base.image != nullptr;
    return look;
}

PaintedMesh paintTriangles(PartMesh mesh, const std::vector<glm::vec3>& tint, const Look& look,
                           float finest, std::size_t budget) {
    PaintedMesh out;
    const auto tintOf = [&](std::uint32_t v) {
        if (v >= tint.size() || glm::any(glm::isnan(tint[v])))
            return glm::vec3(1.0F);
        return glm::clamp(tint[v], 0.0F, 1.0F);
    };
    if (look.base.image == nullptr || mesh.surface.size() != mesh.positions.size()) {
        for (const glm::uvec3& t : mesh.triangles)
            out.color.push_back((tintOf(t.x) + tintOf(t.y) + tintOf(t.z)) / 3.0F *
                                look.material.color);
        out.mesh = std::move(mesh);
        return out;
    }
    const auto cornerOf = [&](std::uint32_t v) {
        return Corner{mesh.positions[v], mesh.normals[v], mesh.surface[v],
                      tintOf(v) * look.material.color};
    };
    Painter painter(look, finest, budget, out);
    for (const glm::uvec3& t : mesh.triangles)
        painter.paint(cornerOf(t.x), cornerOf(t.y), cornerOf(t.z));
    return out;
}

void Palette::add(const glm::vec3& linear, double area) {
    if (glm::any(glm::isnan(linear)) || glm::any(glm::isinf(linear)))
        return;  // of colours that a file gave as no numbers
    const glm::vec3 shown = display(linear) * float(kBins - 1) + 0.5F;
    Bin& bin = m_bins[{int(shown.x), int(shown.y), int(shown.z)}];
    bin.sum += glm::dvec3(linear) * area;
    bin.area += area;
}

void Palette::close() {
    std::vector<Bin> bins;
    for (const auto& [key, bin] : m_bins) {
        if (bin.area > 0.0)
            bins.push_back(bin);
    }
    std::stable_sort(bins.begin(), bins.end(),
                     [](const Bin& a, const Bin& b) { return a.area > b.area; });
    for (const Bin& bin : bins) {
        const glm::vec3 color(bin.sum / bin.area);
        const bool known = std::any_of(m_colors.begin(), m_colors.end(), [&](const glm::vec3& c) {
            return glm::distance(display(c), display(color)) < kMergeColor;
        });
        if (!known && m_colors.size() < kMostColors)
            m_colors.push_back(color);
    }
    if (m_colors.empty())
        m_colors.emplace_back(0.5F);
}

std::size_t Palette::nearest(const glm::vec3& linear) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < m_colors.size(); ++i) {
        if (glm::distance(display(m_colors[i]), display(linear)) <
            glm::distance(display(m_colors[best]), display(linear))) {
            best = i;
        }
    }
    return best;
}

}  // namespace reflet::gltf
