// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/Icons.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QSvgRenderer>

// The icons lie in a static library; the macro must stand outside of namespaces.
static void registerIcons() {
    Q_INIT_RESOURCE(icons);
}

namespace reflet {
namespace {

QByteArray svgText(const QString& name) {
    registerIcons();
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QColor colourOf(QIcon::Mode mode) {
    const QPalette palette = QApplication::palette();
    switch (mode) {
        case QIcon::Disabled:
            return palette.color(QPalette::Disabled, QPalette::ButtonText);
        case QIcon::Selected:
            return palette.color(QPalette::HighlightedText);
        case QIcon::Normal:
        case QIcon::Active:
            break;
    }
    return palette.color(QPalette::Active, QPalette::ButtonText);
}

/// Draws an SVG whose strokes are black (#000) in a colour of the palette.
class TintedIconEngine : public QIconEngine {
public:
    explicit TintedIconEngine(QByteArray svg) : m_svg(std::move(svg)) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
        QByteArray text = m_svg;
        text.replace("#000", colourOf(mode).name().toLatin1());
        QSvgRenderer renderer(text);
        const int side = std::min(rect.width(), rect.height());
        QRect square(0, 0, side, side);
        square.moveCenter(rect.center());
        renderer.render(painter, square);
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap result(size);
        result.fill(Qt::transparent);
        QPainter painter(&result);
        paint(&painter, QRect(QPoint(0, 0), size), mode, state);
        return result;
    }

    [[nodiscard]] QIconEngine* clone() const override { return new TintedIconEngine(m_svg); }
    [[nodiscard]] bool isNull() override { return m_svg.isEmpty(); }

private:
    QByteArray m_svg;
};

}  // namespace

QIcon icon(const QString& name) {
    QByteArray svg = svgText(name);
    return svg.isEmpty() ? QIcon() : QIcon(new TintedIconEngine(std::move(svg)));
}

QIcon programIcon() {
    registerIcons();
    return QIcon(QStringLiteral(":/icons/reflet.svg"));
}

}  // namespace reflet
