// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/gpu/base/Program.h"
#include "core/gpu/reflection/HeightfieldTable.h"
#include "core/gpu/reflection/MapTexels.h"
#include "core/gpu/reflection/QuadTable.h"
#include "core/gpu/reflection/RemStore.h"
#include "core/gpu/reflection/SightTable.h"

#include <memory>
#include <span>
#include <vector>

namespace reflet {

class CityPass;

/// A local environment map on the GPU: a cube map of RGBA16F with all mip levels. rgb: radiance;
/// a: distance in metres, +infinity for sky, negative where uncovered (level 0 alone). Null
/// texture: there is none.
struct GpuLocalMap {
    std::shared_ptr<const Texture> texture;
    std::shared_ptr<Texture> owned;  ///< the same, when it was made for this map alone
    glm::dvec3 center{0.0};
    bool atInfinity = false;  ///< LocalEnvironmentMap::atInfinity
    ReconstructionStatistics statistics;
};

struct LocalMapRequest {
    Method method = Method::Mem;
    glm::dvec3 position{0.0};  ///< project frame
    MemSettings settings;
    std::shared_ptr<const LocalEnvironmentMap> given;  ///< for Method::RayTrace
    /// Method::Rerender draws all that lies in a face's view, also what is smaller than a texel.
    bool everyPart = false;
};

/// Makes local environment maps on the GPU by all methods.
///
/// Mem: the CPU traces the rays and builds the adaptive mesh (buildMemFace), the GPU fills its
/// leaves from the REMs that serve them, one after the other. Texel for texel the same leaf and
/// weights as reconstructMem; what differs is rounding to half floats (2^-11) for each REM and the
/// GPU's filter weights (2^-8 of the difference of neighbouring texels). tests/gpu holds both to
/// 45 dB at least.
///
/// Dense: all on the GPU, in a compute shader on the heightfield's pyramid. Rays are traced in
/// floats and distances of REMs are half floats there, so that single texels at edges fall to the
/// other side: tests/gpu holds it to 40 dB of the CPU's. How many of its texels are uncovered is
/// not told (statistics.uncovered = 0), for the answer would have to be waited for. Box is filled
/// by the CPU.
class LocalMapPass {
public:
    /// Who fills the texels of Mem, Dense, Blend and Nearest. A driver that draws in software takes
    /// three times as long for it as the CPU's own resampler, whose texels are then uploaded, and
    /// milliseconds for even the smallest of maps.
    enum class Fill { Automatic, Gpu, Cpu };

    /// Internal, with the driver's words, when a shader does not compile; fails as usualRemMemory()
    /// does where that is asked.
    [[nodiscard]] static Result<std::unique_ptr<LocalMapPass>> create(
        Fill fill = Fill::Automatic, RemMemory memory = RemMemory::Automatic);

    void setCity(std::shared_ptr<const DrawnCity> city);
    void setRems(const RemSet& rems);
    void setLighting(const Lighting& lighting);
    [[nodiscard]] RemStore& store() { return m_store; }

    /// The CPU's part of some maps: a value for each request.
    struct Traced {
        std::vector<RemCandidates> candidates;  ///< of the maps that the GPU fills by sight
        std::vector<QuadTable> tables;
        std::vector<MapTexels> texels;  ///< of the maps that the CPU fills, else empty
    };
    /// Rays and meshes of all in parallel. Without OpenGL: on any thread, while nothing is set.
    [[nodiscard]] Traced trace(std::span<const LocalMapRequest> requests) const;

    /// One map for each request, in order. `reuse`: textures that may be overwritten, taken where
    /// they fit. city draws Method::Rerender; null gives the sky. Without a city Mem falls back to
    /// Blend. A ray traced map that is not given has a null texture.
    [[nodiscard]] std::vector<GpuLocalMap> draw(std::span<const LocalMapRequest> requests,
                                                const Traced& traced, CityPass* city,
                                                std::vector<std::shared_ptr<Texture>> reuse = {});
    [[nodiscard]] std::vector<GpuLocalMap> draw(std::span<const LocalMapRequest> requests,
                                                CityPass* city) {
        return draw(requests, trace(requests), city);
    }

    /// Whether bindPixels() may be called: there is a city, and it fits into the card's textures.
    [[nodiscard]] bool tracesPixels() const;
    /// For a program with resources/shaders/rem_sight.glsl: the REMs that serve a vehicle around
    /// `middle`, which becomes the origin of its rays.
    void bindPixels(const Program& program, const glm::dvec3& middle, const MemSettings& settings);

    /// A map back in main memory.
    [[nodiscard]] static LocalEnvironmentMap read(const GpuLocalMap& map);

private:
    explicit LocalMapPass(RemMemory memory) : m_store(memory) {}
    /// Whether the adaptive mesh is what a request asks for and there is a city to trace.
    [[nodiscard]] bool isMesh(const LocalMapRequest& request) const;
    /// Whether the GPU traces a request's rays itself.
    [[nodiscard]] bool isDenseOnGpu(const LocalMapRequest& request) const;
    [[nodiscard]] const HeightfieldTable& field();
    [[nodiscard]] ReconstructionInput input() const;
    /// The map of a request that the CPU makes as a whole; nullopt: the GPU does.
    [[nodiscard]] std::optional<LocalEnvironmentMap> fillOnCpu(
        const LocalMapRequest& request, const ReconstructionInput& input) const;
    [[nodiscard]] std::shared_ptr<Texture> target(int resolution,
                                                  std::vector<std::shared_ptr<Texture>>& reuse);
    void drawMesh(const LocalMapRequest& request, const RemCandidates& candidates,
                  const QuadTable& table, int firstLook, const Texture& texture);
    void drawDense(const LocalMapRequest& request, const RemCandidates& candidates,
                   const Texture& texture);
    void bindCandidate(const RemCandidates& candidates, int candidate, const glm::dvec3& position);
    void drawAtInfinity(const LocalMapRequest& request, const Texture& texture);
    void drawCity(const LocalMapRequest& request, CityPass& city, const Texture& texture);
    [[nodiscard]] std::shared_ptr<const Texture> sky(int resolution);
    void bindRems(const Program& program, const RemChoice& choice, const glm::dvec3& position);
    void beginFace(const Program& program, const Texture& texture, int face);

    std::shared_ptr<const DrawnCity> m_city;
    void prepareRems();

    RemSet m_rems;
    std::unique_ptr<PreparedRems> m_prepared;  ///< of m_rems in m_city; null without a city
    RemStore m_store;
    Lighting m_lighting;
    Program m_mesh, m_infinity, m_copy, m_dense;
    HeightfieldTable m_field;  ///< of m_city, once it was asked for
    SightTable m_sight;
    Framebuffer m_framebuffer;
    VertexArray m_noAttributes;
    Buffer m_leaves;
    Texture m_leafView;
    std::shared_ptr<const Texture> m_sky;
    Texture m_faceRadiance, m_faceDistance, m_faceDepth;  ///< where the city draws a face
    Sampler m_unfiltered;
    bool m_fillsOnCpu = false;
    bool m_remsFit = true;     ///< into SightTable
    bool m_fieldFits = false;  ///< m_city has a heightfield that the card's textures hold
};

}  // namespace reflet
