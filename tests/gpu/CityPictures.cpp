// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/gpu/CityPictures.h"

#include "core/gpu/city/CityMesh.h"

namespace reflet::test {

namespace {

/// Direction through a pixel's centre; rows from the top.
glm::vec3 through(const CityView& view, int x, int y) {
    const float s = (2.0F * float(x) + 1.0F) / float(view.width) - 1.0F;
    const float t = 1.0F - (2.0F * float(y) + 1.0F) / float(view.height);
    return glm::normalize(view.forward + s * view.tanHalf.x * view.right +
                          t * view.tanHalf.y * view.up);
}

template <class T>
std::vector<T> fromTheTop(const std::vector<T>& rows, int width, int height) {
    std::vector<T> result;
    result.reserve(rows.size());
    for (int y = height - 1; y >= 0; --y) {
        const auto begin = rows.begin() + std::ptrdiff_t(y) * width;
        result.insert(result.end(), begin, begin + width);
    }
    return result;
}

}  // namespace

DisplayImage RadiancePicture::display() const {
    DisplayImage image{width, height, {}};
    for (const glm::vec3& r : radiance) {
        image.pixels.push_back(toDisplay(r, 1.0F));
    }
    return image;
}

double decibels(const RadiancePicture& a, const RadiancePicture& b) {
    PsnrAccumulator psnr;
    psnr.add(a.display(), b.display());
    return psnr.decibels().value_or(99.0);
}

void CityPictures::SetUp() {
    GlFixture::SetUp();
    if (m_context == nullptr) {
        return;
    }
    auto pass = CityPass::create();
    ASSERT_TRUE(pass) << pass.error().message();
    m_pass = std::move(*pass);
}

void CityPictures::show(const CityModel& city, const Lighting& lighting,
                        std::vector<TextureImage> textures) {
    m_city = std::make_shared<DrawnCity>();
    m_city->model = std::make_shared<CityModel>(city);
    m_city->looks = std::make_shared<SurfaceLooks>(*m_city->model);
    m_city->textures = std::make_shared<std::vector<TextureImage>>(textures);
    m_scene = testing::sceneOf(*m_city->model, lighting, std::move(textures));
    m_pass->setCity(m_city);
    m_pass->setLighting(lighting);
    m_pass->setAmbient(nullptr);
}

void CityPictures::gatherLight(std::size_t nodes) {
    auto volume = gatherAmbient(*m_scene, nodes, {});
    ASSERT_TRUE(volume);
    m_pass->setAmbient(std::make_shared<AmbientVolume>(std::move(*volume)));
}

RadiancePicture CityPictures::drawn(const CityView& view, std::span<const ShadowCaster> casters) {
    const Texture radiance = Texture::make2D(GL_RGBA32F, view.width, view.height);
    const Texture depth = Texture::make2D(GL_DEPTH32F_STENCIL8, view.width, view.height);
    const Texture distance = Texture::make2D(GL_R32F, view.width, view.height);
    m_statistics = m_pass->prepareShadows(view.eye, casters);
    m_statistics.triangles =
        m_pass->draw(view, {radiance.id(), depth.id(), distance.id()}).triangles;
    const auto pixels = std::size_t(view.width) * std::size_t(view.height);
    std::vector<glm::vec3> rgb(pixels);
    std::vector<float> away(pixels);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(radiance.id(), 0, GL_RGB, GL_FLOAT, GLsizei(pixels * sizeof(glm::vec3)),
                      rgb.data());
    glGetTextureImage(distance.id(), 0, GL_RED, GL_FLOAT, GLsizei(pixels * sizeof(float)),
                      away.data());
    return {view.width, view.height, fromTheTop(rgb, view.width, view.height),
            fromTheTop(away, view.width, view.height)};
}

RadiancePicture CityPictures::traced(const CityView& view) const {
    RadiancePicture picture{view.width, view.height, {}, {}};
    const glm::vec3 eye(view.eye);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const glm::vec3 direction = through(view, x, y);
            const SceneHit hit = m_scene->intersect(eye, direction);
            picture.radiance.push_back(m_scene->shade(hit, eye, direction, view.spread));
            picture.distance.push_back(hit.distance);
        }
    }
    return picture;
}

}  // namespace reflet::test
