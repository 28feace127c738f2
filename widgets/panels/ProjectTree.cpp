// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/ProjectTree.h"

#include "widgets/panels/ProjectModel.h"

#include <QContextMenuEvent>
#include <QHeaderView>
#include <QItemSelection>
#include <QLineEdit>
#include <QShortcut>
#include <QSortFilterProxyModel>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>

namespace reflet {

struct ProjectTree::Impl {
    explicit Impl(ProjectTree* owner)
        : tree(owner),
          model([owner](const ProjectItem& item,
                        const QString& name) { Q_EMIT owner->renamed(item, name); },
                owner),
          proxy(owner) {
        proxy.setSourceModel(&model);
        proxy.setRecursiveFilteringEnabled(true);
        proxy.setFilterCaseSensitivity(Qt::CaseInsensitive);
    }

    ProjectTree* tree;
    ProjectModel model;
    QSortFilterProxyModel proxy;
    QTreeView* view = nullptr;
    QLineEdit* filter = nullptr;
    std::vector<ProjectItem> chosen;  ///< what was last reported or set
    bool quiet = false;               ///< the selection changes by no user's hand

    [[nodiscard]] std::vector<ProjectItem> fromView() const {
        std::vector<ProjectItem> items;
        QModelIndexList rows = view->selectionModel()->selectedIndexes();
        std::sort(rows.begin(), rows.end());
        for (const QModelIndex& row : rows)
            if (const auto item = model.item(proxy.mapToSource(row)))
                items.push_back(*item);
        return items;
    }
    void toView() {
        const bool before = std::exchange(quiet, true);
        QItemSelection selection;
        QModelIndex last;
        for (const ProjectItem& item : chosen) {
            const QModelIndex row = proxy.mapFromSource(model.find(item));
            if (!row.isValid())
                continue;
            selection.select(row, row);
            last = row;
        }
        view->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
        if (last.isValid() && !view->hasFocus()) {
            view->selectionModel()->setCurrentIndex(last, QItemSelectionModel::NoUpdate);
            view->scrollTo(last);
        }
        quiet = before;
    }
    void report() {
        if (quiet)
            return;
        chosen = fromView();
        Q_EMIT tree->selectionChanged(chosen);
    }
    void shortcut(const QKeySequence& keys, const std::function<void()>& act) {
        auto* key = new QShortcut(keys, view, nullptr, nullptr, Qt::WidgetShortcut);
        QObject::connect(key, &QShortcut::activated, tree, act);
    }
    void connectAll();
};

void ProjectTree::Impl::connectAll() {
    QObject::connect(view->selectionModel(), &QItemSelectionModel::selectionChanged, tree,
                     [this] { report(); });
    QObject::connect(filter, &QLineEdit::textChanged, tree, [this](const QString& words) {
        quiet = true;  // rows that the filter hides stay selected for the rest of the window
        proxy.setFilterFixedString(words);
        view->expandAll();
        quiet = false;
        toView();
    });
    QObject::connect(&proxy, &QAbstractItemModel::rowsInserted, tree,
                     [this](const QModelIndex& heading, int first, int last) {
                         if (heading.isValid() && proxy.rowCount(heading) == last - first + 1)
                             view->expand(heading);
                     });
    const auto frame = [this](const QModelIndex& row) {
        if (const auto item = model.item(proxy.mapToSource(row)))
            Q_EMIT tree->frameRequested(*item);
    };
    QObject::connect(view, &QTreeView::doubleClicked, tree, frame);
    shortcut(Qt::Key_Return, [this, frame] { frame(view->currentIndex()); });
    shortcut(Qt::Key_Enter, [this, frame] { frame(view->currentIndex()); });
    shortcut(QKeySequence::Delete, [this] {
        if (!fromView().empty())
            Q_EMIT tree->removeRequested(fromView());
    });
    shortcut(Qt::CTRL | Qt::Key_D, [this] {
        if (!fromView().empty())
            Q_EMIT tree->duplicateRequested(fromView());
    });
    QObject::connect(view, &QTreeView::customContextMenuRequested, tree, [this](const QPoint& at) {
        Q_EMIT tree->contextMenuAt(view->viewport()->mapToGlobal(at), fromView());
    });
}

ProjectTree::ProjectTree(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    m_impl->filter = new QLineEdit(this);
    m_impl->filter->setObjectName(QStringLiteral("treeFilter"));
    m_impl->filter->setPlaceholderText(tr("Filter"));
    m_impl->filter->setClearButtonEnabled(true);
    m_impl->filter->setAccessibleName(tr("Filter the project"));
    m_impl->filter->setToolTip(tr("Show only what has these letters in its name"));
    m_impl->view = new QTreeView(this);
    QTreeView* view = m_impl->view;
    view->setObjectName(QStringLiteral("treeView"));
    view->setAccessibleName(tr("Project"));
    view->setModel(&m_impl->proxy);
    view->setHeaderHidden(true);
    view->setUniformRowHeights(true);
    view->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view->setEditTriggers(QAbstractItemView::EditKeyPressed);
    view->setExpandsOnDoubleClick(true);
    view->setTextElideMode(Qt::ElideMiddle);
    view->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    view->setContextMenuPolicy(Qt::CustomContextMenu);
    view->expandAll();
    layout->addWidget(m_impl->filter);
    layout->addWidget(view);
    setFocusProxy(view);
    m_impl->connectAll();
}

ProjectTree::~ProjectTree() = default;

void ProjectTree::setProject(const Project& project) {
    m_impl->quiet = true;
    m_impl->model.setProject(project);
    m_impl->quiet = false;
    // What went and came back (undo) is selected again; what is gone is the caller's to drop.
    if (m_impl->fromView() != m_impl->chosen)
        m_impl->toView();
}

void ProjectTree::setProbeStates(std::map<std::string, ProbeState> states) {
    m_impl->model.setProbeStates(std::move(states));
}

void ProjectTree::setModelMarks(std::map<std::string, FileMark> marks) {
    m_impl->model.setModelMarks(std::move(marks));
}

void ProjectTree::setSelection(const std::vector<ProjectItem>& items) {
    if (m_impl->chosen == items)
        return;
    m_impl->chosen = items;
    m_impl->toView();
}

std::vector<ProjectItem> ProjectTree::selection() const {
    return m_impl->chosen;
}

}  // namespace reflet
