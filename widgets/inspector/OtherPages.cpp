// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "widgets/inspector/InspectorPages.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>

namespace reflet {

namespace {

QString utf16(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

}  // namespace

ModelPage::ModelPage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_file = fact(tr("File"));
    m_format = fact(tr("Format"));
    m_crs = fact(tr("System"), tr("The coordinate system that the file declares"));
    m_objects = fact(tr("Objects"), tr("City objects and triangles that were loaded"));
    m_problem = fact(tr("Note"));
    m_locate = new QPushButton(tr("&Choose the file …"), this);
    m_locate->setObjectName(QStringLiteral("modelLocate"));
    m_locate->setToolTip(tr("Tell where the file is now"));
    connect(m_locate, &QPushButton::clicked, this, [this] { locate(m_path); });
    row(m_locate);
    m_reading = new ReadingForm(this);
    m_reading->changed = [this](ModelReference model) { readingChanged(std::move(model)); };
    row(m_reading);
}

void ModelPage::show(const ModelReference& model, const ModelFacts& facts) {
    m_path = utf16(model.path);
    m_heading->setText(tr("City model"));
    m_file->setText(m_path);
    m_format->setText(facts.format.isEmpty() ? tr("not loaded yet") : facts.format);
    m_crs->setText(!facts.crs.isEmpty() ? facts.crs
                   : !model.crs.empty() ? tr("%1 (given)").arg(utf16(model.crs))
                                        : tr("none declared"));
    const QLocale locale;
    m_objects->setText(tr("%1 with %2 triangles")
                           .arg(locale.toString(facts.objects), locale.toString(facts.triangles)));
    const QString problem = facts.missing   ? tr("The file is not there any more.")
                            : facts.changed ? tr("The file has changed since it was imported.")
                                            : QString();
    m_problem->setText(problem);
    setShown(m_problem, !problem.isEmpty());
    m_locate->setVisible(facts.missing);
    m_reading->show(model, facts);
}

ViewPage::ViewPage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_caption = text(tr("&Caption"), tr("What is written below the picture"),
                     [this](const QString& caption) {
                         m_view.caption = caption.toStdString();
                         changed(utf16(m_view.name), m_view);
                     });
    m_caption->setObjectName(QStringLiteral("viewCaption"));
    const auto onEnd = [this](DragPhase phase) {
        if (phase == DragPhase::End)
            changed(utf16(m_view.name), m_view);
    };
    m_fov = number(tr("&Field of view"), tr("How much is seen from bottom to top"),
                   {5.0, 120.0, 1.0, 1, tr("°")}, [this, onEnd](double value, DragPhase phase) {
                       m_view.verticalFov = value * kPi / 180.0;
                       onEnd(phase);
                   });
    m_time = number(tr("&Time"), tr("Vehicles stand where they are at this time"),
                    {0.0, 1e6, 0.5, 1, tr(" s")}, [this, onEnd](double value, DragPhase phase) {
                        m_view.time = value;
                        onEnd(phase);
                    });
    m_time->setObjectName(QStringLiteral("viewTime"));
    auto* buttons = new QWidget(this);
    auto* layout = new QHBoxLayout(buttons);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* show = new QPushButton(tr("&Go there"), buttons);
    show->setObjectName(QStringLiteral("viewGo"));
    show->setToolTip(tr("Let the 3D view look as this view does"));
    auto* take = new QPushButton(tr("T&ake from 3D view"), buttons);
    take->setObjectName(QStringLiteral("viewTake"));
    take->setToolTip(tr("Let this view look as the 3D view does now"));
    connect(show, &QPushButton::clicked, this, [this] { go(utf16(m_view.name)); });
    connect(take, &QPushButton::clicked, this, [this] { fromCamera(utf16(m_view.name)); });
    layout->addWidget(show);
    layout->addWidget(take);
    layout->addStretch();
    row(buttons);
}

void ViewPage::show(const View& view) {
    m_view = view;
    m_heading->setText(tr("View %1").arg(utf16(view.name)));
    showText(m_caption, utf16(view.caption));
    m_fov->show(view.verticalFov * 180.0 / kPi);
    m_time->show(view.time);
}

ProjectPage::ProjectPage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_heading->setText(tr("Project"));
    m_name = text(tr("&Name"), tr("The project's title in reports"),
                  [this](const QString& name) { named(name); });
    m_name->setObjectName(QStringLiteral("projectName"));
    m_crs = fact(tr("System"), tr("Coordinate system of all positions"));
    m_vertical = fact(tr("Heights"), tr("What heights are measured from"));
    m_origin = fact(tr("Origin"), tr("Subtracted from all coordinates for exact arithmetic"));
    m_counts = fact(tr("Contents"));
    m_heights = new HeightsForm(this);
    m_heights->layout()->setContentsMargins(0, 0, 0, 0);
    m_heights->changed = [this](const HeightfieldSettings& heights, DragPhase phase) {
        heightsChanged(heights, phase);
    };
    row(m_heights);
}

void ProjectPage::show(const Project& project, const QString& crsName) {
    showText(m_name, utf16(project.name));
    m_heights->show(project.heightfield);
    m_crs->setText(crsName.isEmpty() ? tr("local metres") : crsName);
    m_vertical->setText(project.frame.vertical ? utf16(*project.frame.vertical) : tr("not known"));
    const QLocale locale;
    m_origin->setText(QStringLiteral("E %1  N %2")
                          .arg(locale.toString(project.frame.origin.x, 'f', 0),
                               locale.toString(project.frame.origin.y, 'f', 0)));
    m_counts->setText(
        tr("City models: %1\nRoutes: %2\nVehicles: %3\nReflection probes: %4\nViews: %5")
            .arg(project.models.size())
            .arg(project.routes.size())
            .arg(project.reflectors.size())
            .arg(project.probes.size())
            .arg(project.views.size()));
}

}  // namespace reflet
