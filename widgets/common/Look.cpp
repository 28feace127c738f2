// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/Look.h"

#include <QCoreApplication>
#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <QPixmap>
#include <functional>

namespace reflet {

namespace {

constexpr int kIconSize = 16;

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::Look)
};

/// Painted anew for each pixel ratio that screens have.
QIcon paintedIcon(const std::function<void(QPainter&)>& paint) {
    QIcon icon;
    for (const int ratio : {1, 2, 3}) {
        QPixmap pixmap(kIconSize * ratio, kIconSize * ratio);
        pixmap.setDevicePixelRatio(ratio);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        painter.setRenderHint(QPainter::Antialiasing);
        paint(painter);
        icon.addPixmap(pixmap);
    }
    return icon;
}

QPolygonF triangle(const QPointF& center, double radius) {
    return QPolygonF({center + QPointF(0.0, -radius), center + QPointF(0.92 * radius, 0.7 * radius),
                      center + QPointF(-0.92 * radius, 0.7 * radius)});
}

}  // namespace

QColor probeColor(ProbeState state) {
    switch (state) {
        case ProbeState::Fresh:
            return QColor(DataColor::kGreen);
        case ProbeState::Stale:
            return QColor(DataColor::kOrange);
        case ProbeState::Baking:
            return QColor(DataColor::kSky);
        case ProbeState::Refused:
            return QColor(DataColor::kVermilion);
        case ProbeState::Missing:
            break;
    }
    return QColor(DataColor::kGrey);
}

QString probeStateText(ProbeState state) {
    switch (state) {
        case ProbeState::Fresh:
            return Words::tr("up to date");
        case ProbeState::Stale:
            return Words::tr("out of date");
        case ProbeState::Baking:
            return Words::tr("being baked");
        case ProbeState::Refused:
            return Words::tr("refused");
        case ProbeState::Missing:
            break;
    }
    return Words::tr("not baked yet");
}

QString probeStateHelp(ProbeState state) {
    switch (state) {
        case ProbeState::Fresh:
            return Words::tr("The probe's picture shows the city as it is now.");
        case ProbeState::Stale:
            return Words::tr(
                "Something changed since the probe was baked: its place, the light or the "
                "city. Bake it again.");
        case ProbeState::Baking:
            return Words::tr("The probe's picture is being made in the background.");
        case ProbeState::Refused:
            return Words::tr("A probe cannot look around from there. Move it.");
        case ProbeState::Missing:
            break;
    }
    return Words::tr("Vehicles cannot reflect this probe until it is baked.");
}

void paintProbeMark(QPainter& painter, const QPointF& center, double radius, ProbeState state) {
    painter.save();
    const QColor color = probeColor(state);
    painter.setPen(QPen(QColor(0, 0, 0, 190), radius * 0.18));
    painter.setBrush(color);
    const QRectF round(center.x() - radius * 0.85, center.y() - radius * 0.85, radius * 1.7,
                       radius * 1.7);
    switch (state) {
        case ProbeState::Fresh:
            painter.drawEllipse(round);
            break;
        case ProbeState::Stale:
            painter.drawPolygon(triangle(center, radius));
            break;
        case ProbeState::Baking:
            painter.drawPie(round, 90 * 16, -270 * 16);
            break;
        case ProbeState::Missing: {
            const QRectF ring =
                round.adjusted(radius * 0.2, radius * 0.2, -radius * 0.2, -radius * 0.2);
            painter.setBrush(QColor(255, 255, 255, 230));
            painter.drawEllipse(round);
            painter.setPen(QPen(color.darker(130), radius * 0.32));
            painter.drawEllipse(ring);
            break;
        }
        case ProbeState::Refused: {
            painter.drawRect(round);
            painter.setPen(QPen(Qt::white, radius * 0.34, Qt::SolidLine, Qt::RoundCap));
            const double arm = radius * 0.4;
            painter.drawLine(center + QPointF(-arm, -arm), center + QPointF(arm, arm));
            painter.drawLine(center + QPointF(-arm, arm), center + QPointF(arm, -arm));
            break;
        }
    }
    painter.restore();
}

QIcon probeIcon(ProbeState state) {
    return paintedIcon([state](QPainter& painter) {
        paintProbeMark(painter, {kIconSize / 2.0, kIconSize / 2.0}, 6.5, state);
    });
}

QString methodText(Method method) {
    switch (method) {
        case Method::Sky:
            return Words::tr("Sky only");
        case Method::Nearest:
            return Words::tr("Nearest probe");
        case Method::Blend:
            return Words::tr("Two probes blended");
        case Method::Box:
            return Words::tr("Nearest probe on a box");
        case Method::Mem:
            return Words::tr("Reflet");
        case Method::Dense:
            return Words::tr("Reflet, texel by texel");
        case Method::PerPixel:
            return Words::tr("Reflet, pixel by pixel");
        case Method::Rerender:
            return Words::tr("Drawn anew");
        case Method::RayTrace:
            return Words::tr("Reference, ray traced");
    }
    return {};
}

QString methodHelp(Method method) {
    switch (method) {
        case Method::Sky:
            return Words::tr("The bare sky: what vehicles show without any reflection probe.");
        case Method::Nearest:
            return Words::tr("The picture of the nearest probe, as if all of it were far away.");
        case Method::Blend:
            return Words::tr("The pictures of two probes mixed, as if all were far away.");
        case Method::Box:
            return Words::tr(
                "The picture of the nearest probe, as if it were painted on a box around it that "
                "fits the street best: what games do.");
        case Method::Mem:
            return Words::tr(
                "Several probes put together again where the vehicle is, with the true "
                "distances of the city (Meyer and Loscos 2003).");
        case Method::Dense:
            return Words::tr(
                "As Reflet, with a ray for each texel of the picture in the place of a mesh: what "
                "a finer mesh could reach at best.");
        case Method::PerPixel:
            return Words::tr(
                "As Reflet, with a ray for each pixel of the vehicle, from its surface and not "
                "from "
                "its middle: what stands near is in its place all along a tram.");
        case Method::Rerender:
            return Words::tr("The city drawn six times around the vehicle by the graphics card.");
        case Method::RayTrace:
            return Words::tr(
                "Each direction followed into the full city model: slow, and what the "
                "other methods are measured against.");
    }
    return {};
}

QIcon severityIcon(Severity severity) {
    return paintedIcon([severity](QPainter& painter) {
        const QPointF center(kIconSize / 2.0, kIconSize / 2.0);
        const double radius = 7.0;
        painter.setPen(Qt::NoPen);
        QColor ink = Qt::white;
        QString letter = QStringLiteral("i");
        if (severity == Severity::Info) {
            painter.setBrush(QColor(DataColor::kBlue));
            painter.drawEllipse(center, radius, radius);
        } else if (severity == Severity::Warning) {
            painter.setBrush(QColor(DataColor::kOrange));
            painter.drawPolygon(triangle(center + QPointF(0.0, 1.2), radius + 1.0));
            ink = Qt::black;
            letter = QStringLiteral("!");
        } else {
            painter.setBrush(QColor(DataColor::kVermilion));
            painter.drawRoundedRect(QRectF(1.0, 1.0, 14.0, 14.0), 3.0, 3.0);
            letter = QStringLiteral("×");
        }
        QFont font = painter.font();
        font.setPixelSize(severity == Severity::Error ? 14 : 11);
        font.setBold(true);
        painter.setFont(font);
        painter.setPen(ink);
        const double lower = severity == Severity::Warning ? 2.0 : 0.0;
        painter.drawText(QRectF(0.0, lower, kIconSize, kIconSize), Qt::AlignCenter, letter);
    });
}

QString severityText(Severity severity) {
    switch (severity) {
        case Severity::Info:
            return Words::tr("Note");
        case Severity::Warning:
            return Words::tr("Warning");
        case Severity::Error:
            break;
    }
    return Words::tr("Error");
}

bool isDark(const QPalette& palette) {
    return palette.color(QPalette::WindowText).lightness() >
           palette.color(QPalette::Window).lightness();
}

QColor mutedText(const QPalette& palette) {
    const QColor text = palette.color(QPalette::WindowText);
    const QColor ground = palette.color(QPalette::Window);
    constexpr double kStrength = 0.72;  // still 4.5:1 for the usual black on light grey
    const auto mix = [](int a, int b) { return int(kStrength * a + (1.0 - kStrength) * b); };
    return {mix(text.red(), ground.red()), mix(text.green(), ground.green()),
            mix(text.blue(), ground.blue())};
}

QString metresText(double metres, int decimals) {
    return Words::tr("%1 m").arg(QLocale().toString(metres, 'f', decimals));
}

}  // namespace reflet
