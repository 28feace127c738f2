// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityPass.h"

namespace reflet {

struct CityMesh {};

struct CityPass::Impl {};

std::shared_ptr<const CityMesh> buildCityMesh(const std::shared_ptr<const DrawnCity>&) {
    return std::make_shared<CityMesh>();
}

CityPass::CityPass() : m_impl(std::make_unique<Impl>()) {}
CityPass::~CityPass() = default;

Result<std::unique_ptr<CityPass>> CityPass::create() {
    return std::unique_ptr<CityPass>(new CityPass);
}
void CityPass::setCity(std::shared_ptr<const DrawnCity>, std::shared_ptr<const CityMesh>) {}
void CityPass::setLighting(const Lighting&) {}
void CityPass::setAmbient(const std::shared_ptr<const AmbientVolume>&) {}
CityStatistics CityPass::prepareShadows(const glm::dvec3&, std::span<const ShadowCaster>) {
    return {};
}
CityStatistics CityPass::draw(const CityView&, const CityTargets&) {
    return {};
}
void CityPass::bindLight() const {}

}  // namespace reflet
