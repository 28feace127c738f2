// SPDX-License-Identifier: GPL-3.0-or-later
// Reference maps that are compressed on the GPU, beside what the CPU makes of the same bits.
#include "core/environment/CompressedMap.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/SceneRenderer.h"
#include "core/gpu/reflection/LocalMapPass.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <array>
#include <cmath>
#include <random>

namespace reflet {
namespace {

constexpr int kResolution = 64;

double decibels(const CubeMap<glm::vec3>& ours, const CubeMap<glm::vec3>& reference) {
    PsnrAccumulator psnr;
    psnr.add(displayStrip(ours, 1.0F), displayStrip(reference, 1.0F));
    return psnr.decibels().value_or(200.0);
}

/// Texels whose distances differ by more than a part.
std::size_t differing(const CubeMap<float>& ours, const CubeMap<float>& reference, float part) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.texels().size(); ++i) {
        const float a = ours.texels()[i];
        const float b = reference.texels()[i];
        count += a != b && !(std::abs(a - b) <= part * b) ? 1 : 0;
    }
    return count;
}

class CompressedMapsOnGpu : public test::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped() || HasFatalFailure())
            return;
        auto made = LocalMapPass::create(LocalMapPass::Fill::Gpu, RemMemory::Compressed);
        ASSERT_TRUE(made) << made.error().message();
        m_pass = std::move(*made);
        auto city = std::make_shared<DrawnCity>();
        city->tracer = m_tracer;
        city->diameter = kDiameter;
        m_pass->setCity(city);
        for (const double x : {-9.0, 2.0, 12.0})
            add(m_city.see("r" + std::to_string(int(x)), {x, 0.5, 2.0}, kResolution, 2));
        m_settings.resolution = kResolution;
    }
    void TearDown() override {
        m_pass.reset();
        GlFixture::TearDown();
    }
    /// To both sets: as it is for the GPU, as it is after compression for the CPU.
    void add(ReferenceEnvironmentMap map) {
        m_left.add(decompressed(compressed(map), map.id, map.center));
        m_rems.add(std::move(map));
        m_pass->setRems(m_rems);
    }
    [[nodiscard]] LocalEnvironmentMap draw(Method method) {
        const LocalMapRequest request{method, m_position, m_settings, nullptr};
        return LocalMapPass::read(m_pass->draw({&request, 1}, nullptr).front());
    }
    /// The same places are served by the same maps, chosen before compression, as on the GPU.
    template <class Reconstruct>
    [[nodiscard]] LocalEnvironmentMap onCpu(const RemSet& rems, const Reconstruct& make) const {
        const PreparedRems prepared(m_tracer, m_rems);
        return make(ReconstructionInput{m_tracer.get(), rems, kDiameter, &prepared}, m_position,
                    m_settings, nullptr);
    }

    static constexpr double kDiameter = 150.0;
    test::BoxCity m_city = test::streetCity();
    std::shared_ptr<const HeightfieldTracer> m_tracer =
        std::make_shared<HeightfieldTracer>(m_city.heightfield());
    RemSet m_rems, m_left;
    glm::dvec3 m_position{1.7, -2.2, 1.6};
    MemSettings m_settings;
    std::unique_ptr<LocalMapPass> m_pass;
};

/// What the driver makes of a block of random colours is what our decoder does.
TEST_F(CompressedMapsOnGpu, RadianceIsReadByTheDriverAsByUs) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> exponent(-18.0F, 15.9F);
    std::uniform_real_distribution<float> near(0.8F, 1.25F);
    constexpr int kEdge = 128;
    CubeMap<glm::vec3> radiance(kEdge);
    for (int block = 0; block < 6 * kEdge * kEdge / 16; ++block) {
        const glm::vec3 base(std::exp2(exponent(random)), std::exp2(exponent(random)),
                             std::exp2(exponent(random)));
        for (int i = 0; i < 16; ++i) {
            // Alike, scattered and of one colour: all forms.
            const glm::vec3 other(std::exp2(exponent(random)));
            const glm::vec3 colour = block % 4 == 0   ? base
                                     : block % 4 == 1 ? other
                                     : block % 4 == 2 ? base * near(random)
                                                      : glm::mix(base, other, 0.001F);
            const int row = block / (kEdge / 4) * 4 + i / 4;
            radiance.at(row / kEdge, block % (kEdge / 4) * 4 + i % 4, row % kEdge) = colour;
        }
    }
    const auto map = std::make_shared<const ReferenceEnvironmentMap>(
        ReferenceEnvironmentMap{"r", {}, radiance, CubeMap<float>(kEdge, kInfinity)});
    RemStore store(RemMemory::Compressed);
    const RemStore::Place place = store.places(map, nullptr).a;
    std::vector<float> texels(radiance.texels().size() * 3);
    glGetTextureSubImage(place.texture, 0, 0, 0, 6 * place.cube, kEdge, kEdge, 6, GL_RGB, GL_FLOAT,
                         GLsizei(texels.size() * sizeof(float)), texels.data());
    const CubeMap<glm::vec3> ours = decodeBc6h(encodeBc6h(radiance));
    std::size_t differ = 0;
    for (std::size_t i = 0; i < ours.texels().size(); ++i) {
        for (int c = 0; c < 3; ++c)
            differ += texels[3 * i + std::size_t(c)] != ours.texels()[i][c] ? 1 : 0;
    }
    EXPECT_EQ(differ, 0U);
}

TEST_F(CompressedMapsOnGpu, TakeAFifthOfTheMemory) {
    RemStore plain(RemMemory::Plain);
    RemStore small(RemMemory::Compressed);
    static_cast<void>(plain.places(m_rems.pointers()[0], m_rems.pointers()[1]));
    static_cast<void>(small.places(m_rems.pointers()[0], m_rems.pointers()[1]));
    EXPECT_FALSE(plain.compresses());
    EXPECT_TRUE(small.compresses());
    EXPECT_EQ(2 * plain.bytes() * 3, 8 * small.bytes() * 4);  // 8 and 1.5 bytes a texel
}

/// REFLET_PROBE_MEMORY for as long as it lives.
class ProbeMemoryVariable {
public:
    explicit ProbeMemoryVariable(const char* value) { setenv("REFLET_PROBE_MEMORY", value, 1); }
    ~ProbeMemoryVariable() { unsetenv("REFLET_PROBE_MEMORY"); }
    ProbeMemoryVariable(const ProbeMemoryVariable&) = delete;
    ProbeMemoryVariable& operator=(const ProbeMemoryVariable&) = delete;
};

TEST_F(CompressedMapsOnGpu, AreTheUsersChoice) {
    for (const auto& [value, expected] :
         {std::pair{"compressed", RemMemory::Compressed}, {"plain", RemMemory::Plain}}) {
        const ProbeMemoryVariable variable(value);
        const auto memory = usualRemMemory();
        ASSERT_TRUE(memory) << memory.error().message();
        EXPECT_EQ(*memory, expected);
        const auto pass = LocalMapPass::create();
        ASSERT_TRUE(pass) << pass.error().message();
        EXPECT_EQ((*pass)->store().compresses(), expected == RemMemory::Compressed);
    }
}

TEST_F(CompressedMapsOnGpu, AChoiceThatIsNotKnownIsToldWithThoseThatAre) {
    const ProbeMemoryVariable variable("compresed");
    const auto renderer = SceneRenderer::create();
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.error().code, ErrorCode::Usage);
    EXPECT_EQ(renderer.error().subject, "REFLET_PROBE_MEMORY=compresed");
    EXPECT_NE(renderer.error().remedy.find("\"plain\""), std::string::npos);
    EXPECT_NE(renderer.error().remedy.find("\"compressed\""), std::string::npos);
    // Who has chosen otherwise does not ask.
    EXPECT_TRUE(LocalMapPass::create(LocalMapPass::Fill::Automatic, RemMemory::Plain));
}

TEST_F(CompressedMapsOnGpu, AnEmptyChoiceIsNone) {
    const ProbeMemoryVariable variable("");
    const auto empty = usualRemMemory();
    ASSERT_TRUE(empty) << empty.error().message();
    unsetenv("REFLET_PROBE_MEMORY");
    EXPECT_EQ(*empty, usualRemMemory().value());
    EXPECT_NE(*empty, RemMemory::Automatic);
}

/// A map stays what it is when its array grows, and when others come and go.
TEST_F(CompressedMapsOnGpu, StayWhatTheyAreInAnArrayThatGrows) {
    m_position = m_rems[0].center;
    const LocalEnvironmentMap before = draw(Method::Nearest);
    for (int k = 0; k < 9; ++k)
        add(test::plainMap("p" + std::to_string(k), {200.0 + k, 0.0, 0.0}, kResolution,
                           glm::vec3(0.5F), 4.0F));
    for (std::size_t k = 3; k < 12; ++k)
        static_cast<void>(m_pass->store().places(m_rems.pointers()[k], nullptr));
    const LocalEnvironmentMap after = draw(Method::Nearest);
    EXPECT_EQ(after.radiance.texels(), before.radiance.texels());
    EXPECT_EQ(after.distance.texels(), before.distance.texels());
}

/// A look-up at infinity of the same resolution shows each texel of the map itself.
TEST_F(CompressedMapsOnGpu, DistancesAreReadInTheShaderAsByUs) {
    for (std::size_t i = 0; i < m_rems.size(); ++i) {
        m_position = m_rems[i].center;
        const LocalEnvironmentMap ours = draw(Method::Nearest);
        EXPECT_EQ(differing(ours.distance, m_left[i].distance, 1.0F / 1024.0F), 0U);
        EXPECT_GT(decibels(ours.radiance, m_left[i].radiance), 60.0);
    }
}

TEST_F(CompressedMapsOnGpu, AlsoOfAnEdgeThatIsNoMultipleOfFour) {
    m_settings.resolution = 50;
    m_position = {40.0, 0.5, 2.0};
    add(m_city.see("odd", m_position, 50, 2));
    const LocalEnvironmentMap ours = draw(Method::Nearest);
    EXPECT_EQ(differing(ours.distance, m_left[3].distance, 1.0F / 1024.0F), 0U);
    EXPECT_GT(decibels(ours.radiance, m_left[3].radiance), 60.0);
}

TEST_F(CompressedMapsOnGpu, MakeTheLocalMapsThatTheCpuMakesOfTheSameBits) {
    EXPECT_GT(
        decibels(draw(Method::Blend).radiance,
                 reconstructBlend({m_tracer.get(), m_left}, m_position, kResolution).radiance),
        45.0);
    const LocalEnvironmentMap dense = draw(Method::Dense);
    const LocalEnvironmentMap expected = onCpu(m_left, reconstructDense);
    EXPECT_GT(decibels(dense.radiance, expected.radiance), 40.0);
    EXPECT_LE(differing(dense.distance, expected.distance, 0.01F),
              expected.distance.texels().size() / 500);
    // Its mesh is the CPU's, of uncompressed distances.
    EXPECT_GT(decibels(draw(Method::Mem).radiance, onCpu(m_left, reconstructMem).radiance), 40.0);
}

/// Of all that reaches the picture: nearly what uncompressed maps give.
TEST_F(CompressedMapsOnGpu, ChangeLocalMapsByLittle) {
    const LocalEnvironmentMap dense = draw(Method::Dense);
    const LocalEnvironmentMap plain = onCpu(m_rems, reconstructDense);
    EXPECT_GT(decibels(dense.radiance, plain.radiance), 36.0);
    std::size_t uncovered = 0;
    for (std::size_t i = 0; i < plain.uncovered.texels().size(); ++i)
        uncovered += plain.uncovered.texels()[i] != dense.uncovered.texels()[i] ? 1 : 0;
    EXPECT_LE(uncovered, plain.uncovered.texels().size() / 200);
}

}  // namespace
}  // namespace reflet
