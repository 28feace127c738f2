// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/inspector/Inspector.h"

#include "widgets/inspector/InspectorPages.h"

#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

namespace reflet {

struct Inspector::Impl {
    explicit Impl(Inspector* inspector)
        : owner(inspector),
          probePage(new ProbePage(inspector)),
          routePage(new RoutePage(inspector)),
          reflectorPage(new ReflectorPage(inspector)),
          vehiclePage(new VehiclePage(inspector)),
          modelPage(new ModelPage(inspector)),
          viewPage(new ViewPage(inspector)),
          projectPage(new ProjectPage(inspector)),
          mixed(new QLabel(inspector)) {}

    Inspector* owner;
    ProbePage* probePage;
    RoutePage* routePage;
    ReflectorPage* reflectorPage;
    VehiclePage* vehiclePage;
    ModelPage* modelPage;
    ViewPage* viewPage;
    ProjectPage* projectPage;
    QLabel* mixed;  ///< said of a selection of different kinds

    Project project;
    QString crsName;
    std::vector<ProjectItem> selection;
    std::map<std::string, ProbeFacts> probeFacts;
    std::map<std::string, ModelFacts> modelFacts;
    std::map<std::string, QString> figures;

    [[nodiscard]] std::vector<QWidget*> pages() const {
        return {probePage, routePage, reflectorPage, vehiclePage,
                modelPage, viewPage,  projectPage,   mixed};
    }
    void connectPages();
    void refresh();
    [[nodiscard]] QWidget* fill();
    /// The selected things among all of their kind.
    template <class T, class Name>
    [[nodiscard]] std::vector<T> chosen(const std::vector<T>& all, const Name& name) const {
        std::vector<T> result;
        for (const T& thing : all)
            if (std::any_of(selection.begin(), selection.end(),
                            [&](const ProjectItem& item) { return item.id == name(thing); }))
                result.push_back(thing);
        return result;
    }
};

void Inspector::Impl::connectPages() {
    const auto rename = [this](const ProjectItem& item, const QString& name) {
        Q_EMIT owner->renamed(item, name);
    };
    probePage->renamed = rename;
    reflectorPage->renamed = rename;
    probePage->changed = [this](const std::vector<Probe>& probes, DragPhase phase) {
        Q_EMIT owner->probesChanged(probes, phase);
    };
    probePage->bake = [this](const std::vector<std::string>& ids) {
        Q_EMIT owner->bakeRequested(ids);
    };
    probePage->preview = [this](const std::vector<std::string>& ids, bool on) {
        Q_EMIT owner->previewToggled(ids, on);
    };
    routePage->changed = [this](const std::vector<RouteSpec>& routes, DragPhase phase) {
        Q_EMIT owner->routesChanged(routes, phase);
    };
    reflectorPage->changed = [this](const std::vector<Reflector>& reflectors, DragPhase phase) {
        Q_EMIT owner->reflectorsChanged(reflectors, phase);
    };
    vehiclePage->changed = [this](const VehicleModel& vehicle, DragPhase phase) {
        Q_EMIT owner->vehicleChanged(vehicle, phase);
    };
    modelPage->locate = [this](const QString& path) { Q_EMIT owner->locateFileRequested(path); };
    modelPage->readingChanged = [this](const ModelReference& model) {
        Q_EMIT owner->readingChanged(model);
    };
    viewPage->changed = [this](const QString& name, const View& view) {
        Q_EMIT owner->viewChanged(name, view);
    };
    viewPage->fromCamera = [this](const QString& name) {
        Q_EMIT owner->viewFromCameraRequested(name);
    };
    viewPage->go = [this](const QString& name) { Q_EMIT owner->viewShown(name); };
    projectPage->heightsChanged = [this](const HeightfieldSettings& heights, DragPhase phase) {
        Q_EMIT owner->heightfieldChanged(heights, phase);
    };
    projectPage->named = [this](const QString& name) { Q_EMIT owner->projectNameChanged(name); };
}

void Inspector::Impl::refresh() {
    QWidget* shown = fill();
    for (QWidget* page : pages())
        if (page != shown)
            page->hide();
    shown->setVisible(true);
}

/// Fills the page for the selection and returns it.
QWidget* Inspector::Impl::fill() {
    using Kind = ProjectItem::Kind;
    const auto id = [](const auto& thing) { return thing.id; };
    const bool oneKind = std::all_of(selection.begin(), selection.end(), [&](const auto& item) {
        return item.kind == selection.front().kind;
    });
    mixed->setText(
        tr("%n things of different kinds are selected.", nullptr, int(selection.size())));
    if (!oneKind)
        return mixed;
    const Kind kind = selection.empty() ? Kind::Model : selection.front().kind;
    if (kind == Kind::Probe) {
        if (auto probes = chosen(project.probes, id); !probes.empty()) {
            probePage->show(project, crsName, std::move(probes), probeFacts);
            return probePage;
        }
    } else if (kind == Kind::Route) {
        if (auto routes = chosen(project.routes, id); !routes.empty()) {
            routePage->show(std::move(routes));
            return routePage;
        }
    } else if (kind == Kind::Reflector) {
        if (auto reflectors = chosen(project.reflectors, id); !reflectors.empty()) {
            reflectorPage->show(project, std::move(reflectors), figures);
            return reflectorPage;
        }
    } else if (kind == Kind::Vehicle) {
        if (const auto vehicles = chosen(project.vehicles, id); !vehicles.empty()) {
            vehiclePage->show(vehicles.front());
            return vehiclePage;
        }
    } else if (kind == Kind::View) {
        const auto views = chosen(project.views, [](const View& view) { return view.name; });
        if (!views.empty()) {
            viewPage->show(views.front());
            return viewPage;
        }
    } else {
        const auto models =
            chosen(project.models, [](const ModelReference& model) { return model.path; });
        if (!models.empty()) {
            modelPage->show(models.front(), modelFacts[models.front().path]);
            return modelPage;
        }
    }
    projectPage->show(project, crsName);
    return projectPage;
}

Inspector::Inspector(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    setAccessibleName(tr("Inspector"));
    auto* content = new QWidget(this);
    auto* column = new QVBoxLayout(content);
    column->setContentsMargins(0, 0, 0, 0);
    for (QWidget* page : m_impl->pages()) {
        page->setParent(content);
        page->hide();
        column->addWidget(page);
    }
    m_impl->mixed->setWordWrap(true);
    m_impl->mixed->setContentsMargins(8, 8, 8, 8);
    column->addStretch();
    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(content);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    m_impl->connectPages();
    m_impl->refresh();
}

Inspector::~Inspector() = default;

void Inspector::setProject(const Project& project, const QString& crsName) {
    m_impl->project = project;
    m_impl->crsName = crsName;
    m_impl->refresh();
}

void Inspector::setSelection(const std::vector<ProjectItem>& items) {
    m_impl->selection = items;
    m_impl->refresh();
}

void Inspector::setProbeFacts(std::map<std::string, ProbeFacts> facts) {
    m_impl->probeFacts = std::move(facts);
    m_impl->refresh();
}

void Inspector::setModelFacts(std::map<std::string, ModelFacts> facts) {
    m_impl->modelFacts = std::move(facts);
    m_impl->refresh();
}

void Inspector::setReflectorFigures(std::map<std::string, QString> figures) {
    m_impl->figures = std::move(figures);
    m_impl->refresh();
}

}  // namespace reflet
