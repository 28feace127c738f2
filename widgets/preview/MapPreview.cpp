// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/preview/MapPreview.h"

namespace reflet {
struct MapPreview::Impl {};
MapPreview::MapPreview(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {}
MapPreview::~MapPreview() = default;
void MapPreview::setReference(std::shared_ptr<const ReferenceEnvironmentMap>, const QString&) {}
void MapPreview::setLocalMap(std::shared_ptr<const LocalEnvironmentMap>, const QString&) {}
void MapPreview::setExposure(float) {}
void MapPreview::setProjection(MapProjection) {}
void MapPreview::setQuantity(MapQuantity) {}
}  // namespace reflet
