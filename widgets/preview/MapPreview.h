// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"

#include <QString>
#include <QWidget>
#include <memory>

namespace reflet {

enum class MapProjection { Cross, Sphere };
enum class MapQuantity { Radiance, Distance, Validity };

/// An environment map, looked into: the cube unfolded or a mirror ball, as colours at the project's
/// exposure, as distances, or grey with what no probe sees marked. The wheel zooms to whole texels,
/// a drag pans, and the value under the cursor is written below.
class MapPreview : public QWidget {
    Q_OBJECT

public:
    explicit MapPreview(QWidget* parent = nullptr);
    ~MapPreview() override;

    /// Null: nothing is shown but `title`.
    void setReference(std::shared_ptr<const ReferenceEnvironmentMap> map, const QString& title);
    void setLocalMap(std::shared_ptr<const LocalEnvironmentMap> map, const QString& title);
    /// Words on what lies in the direction that was hovered last, below its value; empty: none.
    void setExplanation(const QString& text);
    void setExposure(float exposure);
    void setProjection(MapProjection projection);
    void setQuantity(MapQuantity quantity);

Q_SIGNALS:
    /// The direction under the cursor, project frame, for marking it elsewhere.
    void directionHovered(glm::dvec3 direction);
    void directionLeft();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
