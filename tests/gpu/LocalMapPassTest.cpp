// SPDX-License-Identifier: GPL-3.0-or-later
// The same local maps from the CPU and from the GPU, texel by texel.
#include "core/environment/CubeDirection.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/reflection/LocalMapPass.h"
#include "core/reconstruction/BoxMap.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {
namespace {

constexpr int kResolution = 64;
constexpr double kDecibels = 45.0;
/// Two roundings to half floats and a filter weight of eight bits, for radiances up to 1.
constexpr float kLinearTolerance = 2.0F / 2048.0F + 1.0F / 256.0F;

struct Agreement {
    double decibels = 0.0;      ///< of display values; 200 when identical
    float largest = 0.0F;       ///< linear difference of a channel
    std::size_t beyond = 0;     ///< texels that differ by more than the tolerance
    std::size_t distances = 0;  ///< texels whose distances differ by more than half floats do
    std::size_t uncovered = 0;  ///< texels whose marks differ
};

Agreement compare(const LocalEnvironmentMap& ours, const LocalEnvironmentMap& reference) {
    Agreement out;
    PsnrAccumulator psnr;
    psnr.add(displayStrip(ours.radiance, 1.0F), displayStrip(reference.radiance, 1.0F));
    out.decibels = psnr.decibels().value_or(200.0);
    for (std::size_t i = 0; i < ours.radiance.texels().size(); ++i) {
        const glm::vec3 d = glm::abs(ours.radiance.texels()[i] - reference.radiance.texels()[i]);
        const float worst = std::max({d.x, d.y, d.z});
        out.largest = std::max(out.largest, worst);
        out.beyond += worst > kLinearTolerance ? 1 : 0;
        const float a = ours.distance.texels()[i];
        const float b = reference.distance.texels()[i];
        out.distances += a != b && !(std::abs(a - b) <= b / 1024.0F) ? 1 : 0;
        out.uncovered += ours.uncovered.texels()[i] != reference.uncovered.texels()[i] ? 1 : 0;
    }
    return out;
}

class LocalMapOnGpu : public test::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped() || HasFatalFailure())
            return;
        make(LocalMapPass::Fill::Gpu);
    }
    void make(LocalMapPass::Fill fill) {
        auto made = LocalMapPass::create(fill);
        ASSERT_TRUE(made) << made.error().message();
        m_pass = std::move(*made);
        auto city = std::make_shared<DrawnCity>();
        city->tracer = m_tracer;
        city->diameter = m_input.sceneDiameter;
        m_pass->setCity(city);
        m_pass->setRems(m_input.rems);
        m_settings.resolution = kResolution;
    }
    void TearDown() override {
        m_pass.reset();
        GlFixture::TearDown();
    }

    [[nodiscard]] LocalEnvironmentMap draw(Method method) {
        const LocalMapRequest request{method, m_position, m_settings, nullptr};
        return LocalMapPass::read(m_pass->draw({&request, 1}, nullptr).front());
    }
    [[nodiscard]] LocalEnvironmentMap onCpu(const glm::dvec3& position) const {
        const std::shared_ptr<const HeightfieldTracer> tracer(m_input.tracer, [](const auto*) {});
        const PreparedRems prepared(tracer, m_input.rems);
        ReconstructionInput input = m_input;
        input.prepared = &prepared;
        return reconstructMem(input, position, m_settings);
    }
    void expectAgreement(const LocalEnvironmentMap& ours, const LocalEnvironmentMap& reference) {
        ASSERT_EQ(ours.radiance.resolution(), reference.radiance.resolution());
        const Agreement found = compare(ours, reference);
        RecordProperty("decibels", std::to_string(found.decibels));
        EXPECT_GT(found.decibels, kDecibels);
        EXPECT_LE(found.beyond, ours.radiance.texels().size() / 2000) << found.largest;
        EXPECT_LE(found.distances, ours.radiance.texels().size() / 2000);
        EXPECT_EQ(found.uncovered, 0U);
    }

    /// A slab from 4 m to 5 m over every cell within 3 m of the vehicle, east and west of it.
    void buildBridge() {
        Heightfield field = m_city.heightfield();
        std::vector<std::uint32_t> cells, first{0};
        std::vector<HeightSpan> spans;
        for (std::size_t cell = 0; cell < field.grid.cellCount(); ++cell) {
            const int i = int(cell % std::size_t(field.grid.columns));
            float& top = field.topCenter[cell];
            if (std::abs(field.grid.xMin(i) - m_position.x) > 3.0 || !(top < 3.0F))
                continue;
            spans.push_back({-kInfinity, top, CityObjectType::TinRelief, false});
            spans.push_back({4.0F, 5.0F, CityObjectType::Bridge, false});
            first.push_back(std::uint32_t(spans.size()));
            cells.push_back(std::uint32_t(cell));
            top = 5.0F;
        }
        ASSERT_GT(cells.size(), 10U);
        field.centerSpans = CellSpans(field.grid.cellCount(), cells, first, spans);
        auto city = std::make_shared<DrawnCity>();
        city->tracer = std::make_shared<HeightfieldTracer>(field);
        city->diameter = m_input.sceneDiameter;
        m_pass->setCity(city);
        m_input.tracer = city->tracer.get();
        m_bridge = city->tracer;
    }

    const test::BoxCity m_city = test::streetCity();
    std::shared_ptr<const HeightfieldTracer> m_bridge;
    const std::shared_ptr<const HeightfieldTracer> m_tracer =
        std::make_shared<HeightfieldTracer>(m_city.heightfield());
    glm::dvec3 m_position{1.7, -2.2, 1.6};
    ReconstructionInput m_input{m_tracer.get(),
                                {m_city.see("west", {-5.0, -1.5, 2.0}, 2 * kResolution, 2),
                                 m_city.see("east", {10.0, -1.5, 2.0}, 2 * kResolution, 2)},
                                250.0};
    MemSettings m_settings;
    std::unique_ptr<LocalMapPass> m_pass;
};

TEST_F(LocalMapOnGpu, IsTheCpusWithTheUsualSettings) {
    const LocalEnvironmentMap ours = draw(Method::Mem);
    const LocalEnvironmentMap reference = onCpu(m_position);
    expectAgreement(ours, reference);
    EXPECT_EQ(ours.statistics.quads, reference.statistics.quads);
    EXPECT_EQ(ours.statistics.rays, reference.statistics.rays);
    EXPECT_EQ(ours.statistics.vertices, reference.statistics.vertices);
    EXPECT_EQ(ours.statistics.uncovered, reference.statistics.uncovered);
    EXPECT_GT(reference.statistics.uncovered, 0U) << "the case should hold uncovered vertices";
}

TEST_F(LocalMapOnGpu, IsTheSameWhenTheCpuFillsItsLeaves) {
    make(LocalMapPass::Fill::Cpu);
    const LocalEnvironmentMap reference = onCpu(m_position);
    const LocalEnvironmentMap ours = draw(Method::Mem);
    expectAgreement(ours, reference);
    EXPECT_EQ(ours.statistics.quads, reference.statistics.quads);
}

TEST_F(LocalMapOnGpu, IsTheCpusUnderABridge) {
    buildBridge();
    const LocalEnvironmentMap reference = onCpu(m_position);
    EXPECT_NEAR(double(reference.distance.at(4, kResolution / 2, kResolution / 2)), 2.4, 0.01);
    expectAgreement(draw(Method::Mem), reference);
}

TEST_F(LocalMapOnGpu, IsTheCpusForEverySettingOfTheMesh) {
    const double never = std::numeric_limits<double>::infinity();
    for (const int meshSize : {1, 7, 10, 64}) {
        for (const double ratio : {0.0, 0.05, 1.0, never}) {
            m_settings.meshSize = meshSize;
            m_settings.depthRatio = ratio;
            m_settings.smallestQuad = ratio == 1.0 ? 3.0 : 1.0;
            SCOPED_TRACE(testing::Message() << "N " << meshSize << ", R " << ratio);
            expectAgreement(draw(Method::Mem), onCpu(m_position));
        }
    }
}

TEST_F(LocalMapOnGpu, IsTheCpusInThePapersForm) {
    m_settings.interpolation = Interpolation::AsInPaper;
    expectAgreement(draw(Method::Mem), onCpu(m_position));
    m_settings.depthRatio = 2.0;
    m_settings.traceEdgeTexels = false;
    expectAgreement(draw(Method::Mem), onCpu(m_position));
}

TEST_F(LocalMapOnGpu, IsTheCpusWithOneReferenceMapAndWithNone) {
    RemSet one;
    one.add(m_input.rems.pointers()[1]);
    m_input.rems = one;
    m_pass->setRems(one);
    expectAgreement(draw(Method::Mem), onCpu(m_position));
    expectAgreement(draw(Method::Blend), reconstructBlend(m_input, m_position, kResolution));
    m_input.rems = {};
    m_pass->setRems({});
    expectAgreement(draw(Method::Mem), onCpu(m_position));
    expectAgreement(draw(Method::Nearest), reconstructNearest(m_input, m_position, kResolution));
}

TEST_F(LocalMapOnGpu, IsTheCpusAtInfinityWhoeverFillsIt) {
    for (const LocalMapPass::Fill fill : {LocalMapPass::Fill::Gpu, LocalMapPass::Fill::Cpu}) {
        make(fill);
        const auto nearest = draw(Method::Nearest);
        expectAgreement(nearest, reconstructNearest(m_input, m_position, kResolution));
        expectAgreement(draw(Method::Blend), reconstructBlend(m_input, m_position, kResolution));
        EXPECT_TRUE(nearest.atInfinity);
    }
}

TEST_F(LocalMapOnGpu, IsTheCpusOnABox) {
    expectAgreement(draw(Method::Box), reconstructBox(m_input, m_position, kResolution));
}

TEST_F(LocalMapOnGpu, OfOneTexelDoesNotBreak) {
    m_settings.resolution = 1;
    const LocalEnvironmentMap ours = draw(Method::Mem);
    const LocalEnvironmentMap reference = onCpu(m_position);
    EXPECT_EQ(compare(ours, reference).beyond, 0U);
}

TEST_F(LocalMapOnGpu, OfTheSkyIsTheSky) {
    Lighting lighting;
    lighting.turbidity = 4.0F;
    m_pass->setLighting(lighting);
    const LocalEnvironmentMap ours = draw(Method::Sky);
    const Sky sky(lighting);
    for (int face = 0; face < 6; ++face) {
        const glm::vec3 direction = glm::normalize(texelDirection(kResolution, face, 20, 9));
        const glm::vec3 expected = sky.radiance(direction);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(ours.radiance.at(face, 20, 9)[k], expected[k], expected[k] / 1024.0F);
        EXPECT_EQ(ours.distance.at(face, 20, 9), kInfinity);
    }
}

TEST_F(LocalMapOnGpu, ThatWasRayTracedIsShownAsItWasGiven) {
    auto given = std::make_shared<LocalEnvironmentMap>();
    given->radiance = CubeMap<glm::vec3>(8, glm::vec3(0.5F, 0.25F, 70000.0F));
    given->distance = CubeMap<float>(8, 12.0F);
    given->uncovered = CubeMap<unsigned char>(8, 0);
    const LocalMapRequest request{Method::RayTrace, m_position, m_settings, given};
    const LocalEnvironmentMap ours =
        LocalMapPass::read(m_pass->draw({&request, 1}, nullptr).front());
    EXPECT_EQ(ours.radiance.at(3, 2, 1), glm::vec3(0.5F, 0.25F, 65504.0F));
    EXPECT_EQ(ours.distance.at(3, 2, 1), 12.0F);
    const LocalMapRequest missing{Method::RayTrace, m_position, m_settings, nullptr};
    EXPECT_EQ(m_pass->draw({&missing, 1}, nullptr).front().texture, nullptr);
}

TEST_F(LocalMapOnGpu, SeveralAtOnceAreEachTheirOwn) {
    std::vector<LocalMapRequest> requests;
    for (const double x : {-3.0, 1.7, 6.0})
        requests.push_back({Method::Mem, {x, -2.2, 1.6}, m_settings, nullptr});
    const std::vector<GpuLocalMap> maps = m_pass->draw(requests, nullptr);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        expectAgreement(LocalMapPass::read(maps[i]), onCpu(requests[i].position));
    }
}

/// Dense maps, whose rays a compute shader traces.
class DenseMapOnGpu : public LocalMapOnGpu {
protected:
    [[nodiscard]] LocalEnvironmentMap reference() const {
        const std::shared_ptr<const HeightfieldTracer> tracer(m_input.tracer, [](const auto*) {});
        const PreparedRems prepared(tracer, m_input.rems);
        ReconstructionInput input = m_input;
        input.prepared = &prepared;
        return reconstructDense(input, m_position, m_settings);
    }
    void expectTheCpus() {
        const LocalEnvironmentMap expected = reference();
        const LocalEnvironmentMap ours = draw(Method::Dense);
        const Agreement found = compare(ours, expected);
        RecordProperty("decibels", std::to_string(found.decibels));
        EXPECT_GT(found.decibels, 40.0);
        const std::size_t texels = expected.distance.texels().size();
        std::size_t elsewhere = 0;
        for (std::size_t i = 0; i < texels; ++i) {
            const float a = ours.distance.texels()[i];
            const float b = expected.distance.texels()[i];
            elsewhere += a != b && !(std::abs(a - b) <= 0.01F * b) ? 1 : 0;
        }
        EXPECT_LE(elsewhere, texels / 500);
        EXPECT_LE(found.uncovered, texels / 1000);
        EXPECT_EQ(ours.statistics.rays, expected.statistics.rays);
    }
};

TEST_F(DenseMapOnGpu, IsTheCpus) {
    expectTheCpus();
}

TEST_F(DenseMapOnGpu, HasTheCpusDistancesWhereHitsStayWhereTheyAre) {
    m_settings.refineHits = false;
    const LocalEnvironmentMap expected = reference();
    const Agreement found = compare(draw(Method::Dense), expected);
    EXPECT_GT(found.decibels, 40.0);
    EXPECT_LE(found.distances, expected.distance.texels().size() / 1000);
    EXPECT_EQ(std::isinf(expected.distance.at(4, 0, 0)), false) << "a house should stand there";
}

TEST_F(DenseMapOnGpu, IsTheCpusAtManyPlaces) {
    // In the street, between cells, on a border of the grid, outside of it, and high above.
    for (const glm::dvec3 at : {glm::dvec3(-12.3, 0.4, 0.7),
                                {0.0, 0.0, 3.0},
                                {25.5, -1.0, 1.5},
                                {-300.0, 40.0, 12.0},
                                {3.0, 2.0, 150.0}}) {
        SCOPED_TRACE(testing::Message() << at.x << " " << at.y << " " << at.z);
        m_position = at;
        expectTheCpus();
    }
}

TEST_F(DenseMapOnGpu, IsTheCpusUnderABridge) {
    buildBridge();
    EXPECT_NEAR(double(reference().distance.at(4, kResolution / 2, kResolution / 2)), 2.4, 0.01);
    expectTheCpus();
}

TEST_F(DenseMapOnGpu, IsTheCpusWithMoreMapsOfSeveralResolutions) {
    for (int k = 0; k < 7; ++k) {
        m_input.rems.add(std::make_shared<ReferenceEnvironmentMap>(m_city.see(
            "more" + std::to_string(k), {-20.0 + 7.0 * k, 1.0, 2.5}, k % 2 == 0 ? 32 : 64, 2)));
    }
    m_pass->setRems(m_input.rems);
    expectTheCpus();
    m_settings.remsPerVehicle = 3;
    expectTheCpus();
}

TEST_F(DenseMapOnGpu, IsTheCpusWithThePapersTwoMaps) {
    m_settings.weighting = Weighting::AsInPaper;
    expectTheCpus();
}

TEST_F(DenseMapOnGpu, IsTheCpusWithOneReferenceMapAndWithNone) {
    RemSet one;
    one.add(m_input.rems.pointers()[1]);
    m_input.rems = one;
    m_pass->setRems(one);
    expectTheCpus();
    m_input.rems = {};
    m_pass->setRems({});
    const LocalEnvironmentMap ours = draw(Method::Dense);
    EXPECT_EQ(ours.radiance.at(0, 3, 4), glm::vec3(0.0F));
    EXPECT_EQ(ours.uncovered.at(0, 3, 4), 1);
}

TEST_F(DenseMapOnGpu, OfMapsOfMoreResolutionsThanTheShaderKnowsIsMadeByTheCpu) {
    for (const int resolution : {16, 24, 32})
        m_input.rems.add(std::make_shared<ReferenceEnvironmentMap>(m_city.see(
            "of" + std::to_string(resolution), {0.5 * resolution, 1.0, 2.5}, resolution, 1)));
    m_pass->setRems(m_input.rems);
    expectAgreement(draw(Method::Dense), reference());
}

/// Whoever fills a map, rough surfaces read its smaller levels.
TEST_F(LocalMapOnGpu, HasAllItsLevels) {
    for (const LocalMapPass::Fill fill : {LocalMapPass::Fill::Cpu, LocalMapPass::Fill::Gpu}) {
        for (const int resolution : {kResolution, 48}) {
            make(fill);
            m_settings.resolution = resolution;
            const LocalMapRequest request{Method::Mem, m_position, m_settings, nullptr};
            const GpuLocalMap map = m_pass->draw({&request, 1}, nullptr).front();
            glm::dvec3 first(0.0);
            for (int level = 0; level < map.texture->levels(); ++level) {
                const int edge = std::max(1, resolution >> level);
                std::vector<glm::vec4> texels(6 * std::size_t(edge) * std::size_t(edge));
                glGetTextureImage(map.texture->id(), level, GL_RGBA, GL_FLOAT,
                                  GLsizei(texels.size() * sizeof(glm::vec4)), texels.data());
                glm::dvec3 mean(0.0);
                for (const glm::vec4& texel : texels)
                    mean += glm::dvec3(texel) / double(texels.size());
                if (level == 0)
                    first = mean;
                // 48 texels do not halve evenly.
                const double tolerance = resolution == kResolution ? 0.002 : 0.1;
                EXPECT_GT(first.g, 0.05);
                EXPECT_NEAR(mean.g, first.g, tolerance * first.g) << resolution << " " << level;
            }
        }
    }
}

}  // namespace
}  // namespace reflet
