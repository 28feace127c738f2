// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/LocalMapPass.h"

#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/environment/CubeDirection.h"
#include "core/gpu/base/GlState.h"
#include "core/gpu/base/GlVersion.h"
#include "core/gpu/base/ShaderLibrary.h"
#include "core/gpu/city/CityPass.h"
#include "core/reconstruction/BoxMap.h"

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

namespace reflet {

namespace {

constexpr int kVerticesPerLook = 6;
constexpr double kMilliseconds = 1e3;
constexpr int kGroupEdge = 8;  // of localmap_dense.comp.glsl

/// The sky from anywhere, at infinity.
MapTexels skyTexels(const Lighting& lighting, int resolution) {
    const Sky sky(lighting);
    const auto n = std::size_t(resolution);
    CubeMap<glm::vec3> radiance(resolution);
    parallelFor(0, 6 * n, 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line / n), row = int(line % n);
            for (int column = 0; column < resolution; ++column) {
                radiance.at(face, column, row) =
                    sky.radiance(glm::normalize(texelDirection(resolution, face, column, row)));
            }
        }
    });
    return mapTexels(radiance, CubeMap<float>(resolution, kInfinity));
}

Texture makeMap(int resolution) {
    Texture texture = Texture::makeCube(GL_RGBA16F, resolution, mipLevels(resolution));
    texture.filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    return texture;
}

/// All levels of a map of the same resolution.
void upload(const MapTexels& texels, const Texture& texture) {
    for (int level = 0; level < texels.levels; ++level) {
        const int edge = texels.resolution >> level;
        glTextureSubImage3D(texture.id(), level, 0, 0, 0, edge, edge, 6, GL_RGBA, GL_HALF_FLOAT,
                            &texels.halves[texels.offset(level)]);
    }
    if (texels.levels < texture.levels())
        texture.generateMipmaps();
}

std::shared_ptr<const Texture> uploaded(const MapTexels& texels) {
    auto texture = std::make_shared<Texture>(makeMap(texels.resolution));
    upload(texels, *texture);
    return texture;
}

/// The map of single rays is the dense one.
bool isDense(Method method) {
    return method == Method::Dense || method == Method::PerPixel;
}

int edgeOf(const MemSettings& settings) {
    return std::max(1, settings.resolution);
}

}  // namespace

Result<std::unique_ptr<LocalMapPass>> LocalMapPass::create(Fill fill, RemMemory memory) {
    if (memory == RemMemory::Automatic) {
        const auto usual = usualRemMemory();
        if (!usual)
            return tl::unexpected(usual.error());
        memory = *usual;
    }
    std::unique_ptr<LocalMapPass> pass(new LocalMapPass(memory));
    pass->m_fillsOnCpu = fill == Fill::Cpu || (fill == Fill::Automatic && contextDrawsInSoftware());
    const auto load = [](Program& program, const char* name) -> Result<void> {
        auto made = makeProgram(name);
        if (!made)
            return tl::unexpected(made.error());
        program = std::move(*made);
        return {};
    };
    for (const auto& [program, name] : {std::pair{&pass->m_mesh, "localmap_mem"},
                                        {&pass->m_infinity, "localmap_infinity"},
                                        {&pass->m_copy, "localmap_copy"},
                                        {&pass->m_dense, "localmap_dense"}}) {
        if (auto loaded = load(*program, name); !loaded)
            return tl::unexpected(loaded.error());
    }
    pass->m_framebuffer = Framebuffer::make();
    pass->m_noAttributes = VertexArray::make();
    pass->m_unfiltered = Sampler::make(GL_NEAREST, GL_NEAREST);
    return pass;
}

void LocalMapPass::setCity(std::shared_ptr<const DrawnCity> city) {
    if (city == m_city)
        return;
    m_city = std::move(city);
    m_field = {};
    m_fieldFits = m_city && m_city->tracer && HeightfieldTable::fits(m_city->tracer->grid());
    prepareRems();
}

const HeightfieldTable& LocalMapPass::field() {
    if (!m_field)
        m_field = HeightfieldTable(*m_city->tracer);
    return m_field;
}

ReconstructionInput LocalMapPass::input() const {
    return {m_city ? m_city->tracer.get() : nullptr, m_rems, m_city ? m_city->diameter : 1.0,
            m_prepared.get()};
}

bool LocalMapPass::tracesPixels() const {
    return m_fieldFits && m_remsFit;
}

void LocalMapPass::bindPixels(const Program& program, const glm::dvec3& middle,
                              const MemSettings& settings) {
    m_sight.bind(program, field(), m_store, m_rems, input().candidates(middle, settings), middle,
                 settings.refineHits);
}

void LocalMapPass::prepareRems() {
    m_prepared =
        m_city && m_city->tracer ? std::make_unique<PreparedRems>(m_city->tracer, m_rems) : nullptr;
}

void LocalMapPass::setRems(const RemSet& rems) {
    if (!(rems == m_rems)) {
        m_rems = rems;
        prepareRems();
    }
    m_store.setRems(rems);
    std::set<int> resolutions;
    for (std::size_t i = 0; i < rems.size(); ++i)
        resolutions.insert(rems[i].radiance.resolution());
    m_remsFit = resolutions.size() <= SightTable::kArrays;
}

void LocalMapPass::setLighting(const Lighting& lighting) {
    if (!(lighting == m_lighting))
        m_sky.reset();
    m_lighting = lighting;
}

LocalMapPass::Traced LocalMapPass::trace(std::span<const LocalMapRequest> requests) const {
    const ReconstructionInput input = this->input();
    Traced traced;
    traced.candidates.resize(requests.size());
    traced.tables.resize(requests.size());
    traced.texels.resize(requests.size());
    parallelFor(0, requests.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const LocalMapRequest& request = requests[i];
            if (const auto map = fillOnCpu(request, input)) {
                traced.texels[i] = mapTexels(map->radiance, map->distance, map->uncovered);
                traced.tables[i].statistics = map->statistics;
            } else if (isDenseOnGpu(request)) {
                traced.candidates[i] = input.candidates(request.position, request.settings);
                const auto edge = std::size_t(edgeOf(request.settings));
                ReconstructionStatistics& statistics = traced.tables[i].statistics;
                statistics.rays = statistics.vertices = 6 * edge * edge;
            } else if (isMesh(request)) {
                traced.candidates[i] = input.candidates(request.position, request.settings);
                traced.tables[i] =
                    buildQuadTable(input, traced.candidates[i], request.position, request.settings);
            }
        }
    });
    return traced;
}

bool LocalMapPass::isMesh(const LocalMapRequest& request) const {
    return request.method == Method::Mem && m_city && m_city->tracer;
}

bool LocalMapPass::isDenseOnGpu(const LocalMapRequest& request) const {
    return isDense(request.method) && !m_fillsOnCpu && tracesPixels();
}

std::optional<LocalEnvironmentMap> LocalMapPass::fillOnCpu(const LocalMapRequest& request,
                                                           const ReconstructionInput& input) const {
    if (isMesh(request) && m_fillsOnCpu)
        return reconstructMem(input, request.position, request.settings);
    if (isDense(request.method) && input.tracer && !isDenseOnGpu(request))
        return reconstructDense(input, request.position, request.settings);
    const int edge = edgeOf(request.settings);
    if (request.method == Method::Box)
        return reconstructBox(input, request.position, edge);
    if (request.method == Method::Blend && m_fillsOnCpu)
        return reconstructBlend(input, request.position, edge);
    if (request.method == Method::Nearest && m_fillsOnCpu)
        return reconstructNearest(input, request.position, edge);
    return std::nullopt;
}

std::vector<GpuLocalMap> LocalMapPass::draw(std::span<const LocalMapRequest> requests,
                                            const Traced& traced, CityPass* city,
                                            std::vector<std::shared_ptr<Texture>> reuse) {
    const std::vector<QuadTable>& tables = traced.tables;
    // All looks in one upload.
    std::vector<glm::vec4> rows;
    std::vector<int> firstLook(requests.size());
    for (std::size_t i = 0; i < tables.size(); ++i) {
        firstLook[i] = int(rows.size()) / QuadTable::kVectors;
        rows.insert(rows.end(), tables[i].rows.begin(), tables[i].rows.end());
    }
    if (!rows.empty()) {
        const unsigned before = m_leaves.id();
        m_leaves.writeGrowing(rows.size() * sizeof(glm::vec4), rows.data());
        if (m_leaves.id() != before)
            m_leafView = Texture::viewOf(GL_RGBA32F, m_leaves);
    }

    std::vector<GpuLocalMap> maps(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const LocalMapRequest& request = requests[i];
        const Stopwatch watch;
        GpuLocalMap& map = maps[i];
        map.center = request.position;
        map.atInfinity = !request.settings.parallax || request.method == Method::Sky ||
                         request.method == Method::Nearest || request.method == Method::Blend;
        map.statistics = tables[i].statistics;
        if (request.method == Method::Sky || (request.method == Method::Rerender && !city)) {
            map.texture = sky(edgeOf(request.settings));
            continue;
        }
        if (request.method == Method::RayTrace) {
            if (request.given) {
                map.texture = uploaded(mapTexels(request.given->radiance, request.given->distance));
                map.statistics = request.given->statistics;
            }
            continue;
        }
        const auto texture = target(edgeOf(request.settings), reuse);
        resetGlState();
        const bool isFilled = !traced.texels[i].empty();
        if (request.method == Method::Rerender) {
            drawCity(request, *city, *texture);
        } else if (isFilled) {
            upload(traced.texels[i], *texture);
        } else if (isDenseOnGpu(request)) {
            drawDense(request, traced.candidates[i], *texture);
        } else if (isMesh(request)) {
            drawMesh(request, traced.candidates[i], tables[i], firstLook[i], *texture);
        } else {
            drawAtInfinity(request, *texture);
        }
        if (!isFilled)
            texture->generateMipmaps();
        map.texture = map.owned = texture;
        map.statistics.milliseconds += kMilliseconds * watch.seconds();
    }
    return maps;
}

std::shared_ptr<Texture> LocalMapPass::target(int resolution,
                                              std::vector<std::shared_ptr<Texture>>& reuse) {
    const auto fitting = std::find_if(reuse.begin(), reuse.end(), [&](const auto& texture) {
        return texture->width() == resolution;
    });
    if (fitting == reuse.end())
        return std::make_shared<Texture>(makeMap(resolution));
    std::shared_ptr<Texture> texture = std::move(*fitting);
    reuse.erase(fitting);
    return texture;
}

void LocalMapPass::beginFace(const Program& program, const Texture& texture, int face) {
    m_framebuffer.attach(GL_COLOR_ATTACHMENT0, texture, 0, face);
    program.set("face", face);
    program.set("resolution", texture.width());
}

void LocalMapPass::bindRems(const Program& program, const RemChoice& choice,
                            const glm::dvec3& position) {
    const auto pointer = [&](const std::optional<std::size_t>& index) {
        return index ? m_rems.pointers()[*index] : RemSet::Pointer{};
    };
    const auto offset = [&](const std::optional<std::size_t>& index) {
        return index ? glm::vec3(position - m_rems[*index].center) : glm::vec3(0.0F);
    };
    const RemStore::Pair places = m_store.places(pointer(choice.a), pointer(choice.b));
    program.set("cubeA", choice.a ? places.a.cube : -1);
    program.set("cubeB", choice.b ? places.b.cube : -1);
    program.set("offsetA", offset(choice.a));
    program.set("offsetB", offset(choice.b));
    glBindTextureUnit(0, places.a.texture);
    glBindTextureUnit(1, places.b.texture);
}

void LocalMapPass::bindCandidate(const RemCandidates& candidates, int candidate,
                                 const glm::dvec3& position) {
    if (candidate < 0) {
        m_mesh.set("cube", -1);
        return;
    }
    const std::size_t rem = candidates.rems[std::size_t(candidate)].rem;
    const RemStore::Place place = m_store.places(m_rems.pointers()[rem], nullptr).a;
    m_mesh.set("cube", place.cube);
    m_mesh.set("offset", glm::vec3(position - m_rems[rem].center));
    glBindTextureUnit(0, place.texture);
}

/// Radiance is added up over the looks of a leaf. Their distance is the same: the larger of it and
/// the -infinity that the map is cleared to.
void LocalMapPass::drawMesh(const LocalMapRequest& request, const RemCandidates& candidates,
                            const QuadTable& table, int firstLook, const Texture& texture) {
    m_leafView.bind(2);
    m_mesh.set("asInPaper", int(request.settings.interpolation == Interpolation::AsInPaper));
    m_mesh.set("sceneDiameter", float(m_city->diameter));
    m_framebuffer.bind();
    m_noAttributes.bind();
    m_mesh.use();
    glViewport(0, 0, texture.width(), texture.width());
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquationSeparate(GL_FUNC_ADD, GL_MAX);
    constexpr std::array<float, 4> kNothing{0.0F, 0.0F, 0.0F, -kInfinity};
    int face = -1;
    for (const QuadTable::Stretch& stretch : table.stretches) {
        bindCandidate(candidates, stretch.candidate, request.position);
        for (; face < stretch.face; ++face) {
            beginFace(m_mesh, texture, face + 1);
            glClearBufferfv(GL_COLOR, 0, kNothing.data());
        }
        m_mesh.set("firstLook", firstLook + stretch.first);
        glDrawArrays(GL_TRIANGLES, 0, kVerticesPerLook * stretch.count);
    }
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
}

void LocalMapPass::drawDense(const LocalMapRequest& request, const RemCandidates& candidates,
                             const Texture& texture) {
    m_sight.bind(m_dense, field(), m_store, m_rems, candidates, request.position,
                 request.settings.refineHits);
    m_dense.use();
    glBindImageTexture(0, texture.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    const auto groups = unsigned(texture.width() + kGroupEdge - 1) / unsigned(kGroupEdge);
    glDispatchCompute(groups, groups, 6);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
}

void LocalMapPass::drawAtInfinity(const LocalMapRequest& request, const Texture& texture) {
    const RemChoice choice = chooseRems(m_rems, request.position);
    bindRems(m_infinity, choice, request.position);
    const bool blends = request.method != Method::Nearest && choice.a && choice.b;
    const double weightB = blends ? blendParameter(m_rems[*choice.a].center,
                                                   m_rems[*choice.b].center, request.position)
                                  : 0.0;
    m_infinity.set("weightB", float(weightB));
    m_infinity.set("resolutionA", 0);
    if (choice.a) {
        const RemSet::Pointer& nearest = m_rems.pointers()[*choice.a];
        const RemStore::Place place = m_store.places(nearest, nullptr).a;
        glBindTextureUnit(2, place.texture);
        glBindTextureUnit(3, place.distances);
        if (place.distances != 0)
            m_infinity.set("resolutionA", nearest->radiance.resolution());
    }
    m_unfiltered.bind(2);
    m_framebuffer.bind();
    m_noAttributes.bind();
    m_infinity.use();
    glViewport(0, 0, texture.width(), texture.width());
    for (int face = 0; face < 6; ++face) {
        beginFace(m_infinity, texture, face);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    Sampler::unbind(2);
}

void LocalMapPass::drawCity(const LocalMapRequest& request, CityPass& city,
                            const Texture& texture) {
    const int edge = texture.width();
    if (m_faceRadiance.width() != edge) {
        m_faceRadiance = Texture::make2D(GL_RGBA16F, edge, edge);
        m_faceDistance = Texture::make2D(GL_R32F, edge, edge);
        m_faceDepth = Texture::make2D(GL_DEPTH32F_STENCIL8, edge, edge);
    }
    for (int face = 0; face < 6; ++face) {
        CityView view = cityFaceView(request.position, face, edge);
        if (request.everyPart)
            view.smallestPart = 0.0F;
        const CityStatistics drawn =
            city.draw(view, {m_faceRadiance.id(), m_faceDepth.id(), m_faceDistance.id()});
        static_cast<void>(drawn);
        resetGlState();
        m_framebuffer.bind();
        m_noAttributes.bind();
        m_copy.use();
        m_faceRadiance.bind(0);
        m_faceDistance.bind(1);
        glViewport(0, 0, edge, edge);
        beginFace(m_copy, texture, face);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

std::shared_ptr<const Texture> LocalMapPass::sky(int resolution) {
    if (!m_sky || m_sky->width() != resolution)
        m_sky = uploaded(skyTexels(m_lighting, resolution));
    return m_sky;
}

LocalEnvironmentMap LocalMapPass::read(const GpuLocalMap& map) {
    LocalEnvironmentMap out;
    out.center = map.center;
    out.atInfinity = map.atInfinity;
    out.statistics = map.statistics;
    if (!map.texture)
        return out;
    const int n = map.texture->width();
    out.radiance = CubeMap<glm::vec3>(n);
    out.distance = CubeMap<float>(n);
    out.uncovered = CubeMap<unsigned char>(n);
    std::vector<float> texels(out.distance.texels().size() * 4);
    glGetTextureImage(map.texture->id(), 0, GL_RGBA, GL_FLOAT,
                      GLsizei(texels.size() * sizeof(float)), texels.data());
    for (std::size_t i = 0; i < out.distance.texels().size(); ++i) {
        const float* texel = &texels[4 * i];
        out.radiance.texels()[i] = {texel[0], texel[1], texel[2]};
        out.distance.texels()[i] = std::abs(texel[3]);
        out.uncovered.texels()[i] = std::signbit(texel[3]) ? 1 : 0;
    }
    return out;
}

}  // namespace reflet
