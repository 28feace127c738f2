// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/preview/MapPreview.h"

#include "widgets/common/ElidedLabel.h"
#include "widgets/common/Look.h"
#include "widgets/preview/MapCanvas.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QVBoxLayout>
#include <cmath>

namespace reflet {

namespace {

/// What the colours of distances mean.
class DistanceLegend : public QWidget {
public:
    using QWidget::QWidget;

    void setRange(const DistanceRange& range) {
        m_range = range;
        update();
    }
    [[nodiscard]] QSize sizeHint() const override { return {200, 2 * fontMetrics().height() + 2}; }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        const int line = fontMetrics().height();
        const QString sky = MapPreview::tr("sky");
        const int box = fontMetrics().horizontalAdvance(sky) + 12;
        const QRect bar(0, 2, width() - box - 10, line - 4);
        for (int x = 0; x < bar.width(); ++x)
            painter.fillRect(bar.left() + x, bar.top(), 1, bar.height(),
                             QColor(distanceColor(at(double(x) / bar.width()), m_range)));
        painter.fillRect(width() - box, bar.top(), box, bar.height(), QColor(kSkyColor));
        painter.setPen(palette().color(QPalette::WindowText));
        constexpr int kTicks = 4;
        for (int i = 0; i <= kTicks; ++i) {
            const double share = double(i) / kTicks;
            const float metres = at(share);
            const QString text = metresText(double(metres), metres < 10.0F ? 1 : 0);
            const int wide = fontMetrics().horizontalAdvance(text);
            const int x = int(share * (bar.width() - wide));
            painter.drawText(x, bar.bottom() + fontMetrics().ascent() + 2, text);
        }
        painter.drawText(QRect(width() - box, bar.bottom(), box, line + 2), Qt::AlignCenter, sky);
    }

private:
    [[nodiscard]] float at(double share) const {
        return m_range.nearest * std::pow(m_range.farthest / m_range.nearest, float(share));
    }
    DistanceRange m_range;
};

}  // namespace

struct MapPreview::Impl {
    ElidedLabel* title = nullptr;
    QComboBox* projection = nullptr;
    QComboBox* quantity = nullptr;
    MapCanvas* canvas = nullptr;
    DistanceLegend* legend = nullptr;
    ElidedLabel* value = nullptr;
    QLabel* explanation = nullptr;

    void show(MapSource source, const QString& name) {
        title->setText(name);
        if (source.distance && !source.distance->empty())
            legend->setRange(distanceRange(*source.distance));
        canvas->setSource(std::move(source));
        value->setText({});
        explanation->setText({});
    }
    [[nodiscard]] QString describe(const Texel& texel) const {
        const MapSource& source = canvas->source();
        const glm::vec3 radiance = source.radiance->at(texel.face, texel.column, texel.row);
        const float distance = source.distance->at(texel.face, texel.column, texel.row);
        const QLocale locale;
        const auto number = [&](float x) { return locale.toString(double(x), 'g', 3); };
        const bool unseen =
            source.uncovered && source.uncovered->at(texel.face, texel.column, texel.row) != 0;
        const QString place = MapPreview::tr("%1, texel %2 / %3 · %4 · radiance %5  %6  %7");
        return (unseen ? place + MapPreview::tr(" · no probe sees this") : place)
            .arg(faceName(texel.face))
            .arg(texel.column)
            .arg(texel.row)
            .arg(std::isfinite(distance) ? metresText(double(distance), 2) : MapPreview::tr("sky"),
                 number(radiance.x), number(radiance.y), number(radiance.z));
    }
};

MapPreview::MapPreview(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {
    setAccessibleName(tr("Environment map"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 4, 4, 4);
    auto* bar = new QHBoxLayout;
    m_impl->title = new ElidedLabel(this);
    m_impl->projection = new QComboBox(this);
    m_impl->projection->setObjectName(QStringLiteral("mapProjection"));
    m_impl->projection->addItems({tr("Unfolded"), tr("Mirror ball")});
    m_impl->projection->setToolTip(
        tr("The six pictures of the map unfolded, or as a ball shows "
           "them"));
    m_impl->projection->setAccessibleName(tr("Shape"));
    m_impl->quantity = new QComboBox(this);
    m_impl->quantity->setObjectName(QStringLiteral("mapQuantity"));
    m_impl->quantity->addItems({tr("Colours"), tr("Distances"), tr("Unseen")});
    m_impl->quantity->setToolTip(
        tr("What is seen, how far away it is, or (in orange) what no probe sees"));
    m_impl->quantity->setAccessibleName(tr("What is shown"));
    bar->addWidget(m_impl->title, 1);
    bar->addWidget(m_impl->projection);
    bar->addWidget(m_impl->quantity);
    layout->addLayout(bar);
    m_impl->canvas = new MapCanvas(this);
    m_impl->canvas->setObjectName(QStringLiteral("mapCanvas"));
    layout->addWidget(m_impl->canvas, 1);
    m_impl->legend = new DistanceLegend(this);
    m_impl->legend->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_impl->legend->hide();
    layout->addWidget(m_impl->legend);
    m_impl->value = new ElidedLabel(this);
    m_impl->value->setObjectName(QStringLiteral("mapValue"));
    layout->addWidget(m_impl->value);
    m_impl->explanation = new QLabel(this);
    m_impl->explanation->setObjectName(QStringLiteral("mapExplanation"));
    m_impl->explanation->setWordWrap(true);
    m_impl->explanation->setTextFormat(Qt::PlainText);
    m_impl->explanation->setForegroundRole(QPalette::PlaceholderText);
    layout->addWidget(m_impl->explanation);

    connect(m_impl->projection, &QComboBox::currentIndexChanged, this,
            [this](int index) { m_impl->canvas->setProjection(MapProjection(index)); });
    connect(m_impl->quantity, &QComboBox::currentIndexChanged, this, [this](int index) {
        m_impl->canvas->setQuantity(MapQuantity(index));
        m_impl->legend->setVisible(MapQuantity(index) == MapQuantity::Distance);
    });
    connect(m_impl->canvas, &MapCanvas::pointed, this,
            [this](bool inside, const Texel& texel, const glm::dvec3& direction) {
                m_impl->value->setText(inside ? m_impl->describe(texel) : QString());
                if (inside)
                    Q_EMIT directionHovered(glm::normalize(direction));
                else
                    Q_EMIT directionLeft();
            });
}

MapPreview::~MapPreview() = default;

void MapPreview::setReference(std::shared_ptr<const ReferenceEnvironmentMap> map,
                              const QString& title) {
    MapSource source;
    if (map && !map->radiance.empty())
        source = {{map, &map->radiance}, {map, &map->distance}};
    m_impl->show(std::move(source), title);
}

void MapPreview::setLocalMap(std::shared_ptr<const LocalEnvironmentMap> map, const QString& title) {
    MapSource source;
    if (map && !map->radiance.empty()) {
        source = {{map, &map->radiance}, {map, &map->distance}};
        if (map->uncovered.resolution() == map->radiance.resolution())
            source.uncovered = {map, &map->uncovered};
    }
    m_impl->show(std::move(source), title);
}

void MapPreview::setExplanation(const QString& text) {
    m_impl->explanation->setText(text);
}

void MapPreview::setExposure(float exposure) {
    m_impl->canvas->setExposure(exposure);
}

void MapPreview::setProjection(MapProjection projection) {
    m_impl->projection->setCurrentIndex(int(projection));
}

void MapPreview::setQuantity(MapQuantity quantity) {
    m_impl->quantity->setCurrentIndex(int(quantity));
}

}  // namespace reflet
