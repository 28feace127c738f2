// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/RemarkList.h"

#include "widgets/common/Look.h"

#include <QAbstractTableModel>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QShortcut>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace reflet {

namespace {

enum Column {
    SeverityColumn,
    ObjectColumn,
    TypeColumn,
    LodColumn,
    ResultColumn,
    CodeColumn,
    TextColumn,
    RemedyColumn,
    FileColumn,
    kColumns
};

constexpr int kSortRole = Qt::UserRole;

class RemarkModel : public QAbstractTableModel {
public:
    using QAbstractTableModel::QAbstractTableModel;

    void set(std::vector<FileRemark> remarks) {
        beginResetModel();
        m_remarks = std::move(remarks);
        endResetModel();
    }
    [[nodiscard]] const FileRemark& at(int row) const { return m_remarks[std::size_t(row)]; }
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : int(m_remarks.size());
    }
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : kColumns;
    }
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                      int role) const override {
        if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
            return {};
        const std::array<QString, kColumns> titles{RemarkList::tr("Kind"),
                                                   RemarkList::tr("Object"),
                                                   RemarkList::tr("Class"),
                                                   RemarkList::tr("LoD"),
                                                   RemarkList::tr("Outcome"),
                                                   RemarkList::tr("Code"),
                                                   RemarkList::tr("What was found"),
                                                   RemarkList::tr("What you can do"),
                                                   RemarkList::tr("File")};
        return titles[std::size_t(section)];
    }
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override {
        const FileRemark& row = at(index.row());
        if (role == Qt::DisplayRole || role == Qt::ToolTipRole)
            return text(row, index.column());
        if (role == kSortRole)
            return index.column() == SeverityColumn ? QVariant(int(row.remark.severity))
                                                    : QVariant(text(row, index.column()));
        if (role == Qt::DecorationRole && index.column() == SeverityColumn)
            return severityIcon(row.remark.severity);
        return {};
    }
    [[nodiscard]] static QString text(const FileRemark& row, int column) {
        switch (column) {
            case SeverityColumn:
                return severityText(row.remark.severity);
            case ObjectColumn:
                return QString::fromStdString(row.remark.object);
            case TypeColumn:
                return row.type;
            case LodColumn:
                return row.lod;
            case ResultColumn:
                return row.result;
            case CodeColumn:
                return QString::fromStdString(row.remark.code);
            case TextColumn:
                return QString::fromStdString(row.remark.text);
            case RemedyColumn:
                return QString::fromStdString(row.remark.remedy);
            default:
                return row.file;
        }
    }

private:
    std::vector<FileRemark> m_remarks;
};

class RemarkFilter : public QSortFilterProxyModel {
public:
    using QSortFilterProxyModel::QSortFilterProxyModel;

    void set(const QString& words, Severity least) {
        m_words = words;
        m_least = least;
        invalidateFilter();
    }

protected:
    [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& /*parent*/) const override {
        const FileRemark& remark = static_cast<RemarkModel*>(sourceModel())->at(row);
        if (remark.remark.severity < m_least)
            return false;
        for (int column = ObjectColumn; column < kColumns; ++column)
            if (RemarkModel::text(remark, column).contains(m_words, Qt::CaseInsensitive))
                return true;
        return m_words.isEmpty();
    }

private:
    QString m_words;
    Severity m_least = Severity::Info;
};

}  // namespace

struct RemarkList::Impl {
    explicit Impl(RemarkList* list) : model(list), filter(list) {
        filter.setSourceModel(&model);
        filter.setSortRole(kSortRole);
    }

    RemarkModel model;
    RemarkFilter filter;
    QTableView* table = nullptr;
    QLineEdit* words = nullptr;
    QComboBox* least = nullptr;
    QLabel* count = nullptr;
    QLabel* whole = nullptr;  ///< of the current row: what was found, and what to do

    void refilter() {
        filter.set(words->text(), Severity(least->currentIndex()));
        showCount();
    }
    void showCount() {
        count->setText(RemarkList::tr("%1 of %2").arg(filter.rowCount()).arg(model.rowCount()));
    }
    void copy() const {
        QModelIndexList rows = table->selectionModel()->selectedRows();
        if (rows.empty())
            for (int row = 0; row < filter.rowCount(); ++row)
                rows << filter.index(row, 0);
        std::sort(rows.begin(), rows.end());
        QStringList lines;
        for (const QModelIndex& row : rows) {
            QStringList cells;
            for (int column = 0; column < kColumns; ++column)
                cells << filter.index(row.row(), column).data().toString();
            lines << cells.join(QLatin1Char('\t'));
        }
        QApplication::clipboard()->setText(lines.join(QLatin1Char('\n')));
    }
    void activate(RemarkList* list, const QModelIndex& index) const {
        const FileRemark& remark = model.at(filter.mapToSource(index).row());
        Q_EMIT list->objectActivated(remark.file, QString::fromStdString(remark.remark.object));
    }

    void showWhole(const QModelIndex& index) {
        const QModelIndex source = filter.mapToSource(index);
        QStringList said;
        if (source.isValid()) {
            const FileRemark& row = model.at(source.row());
            said << RemarkModel::text(row, TextColumn) << RemarkModel::text(row, RemedyColumn);
            said.removeAll(QString());
        }
        whole->setText(said.join(QLatin1Char('\n')));
    }
};

RemarkList::RemarkList(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    setAccessibleName(tr("Remarks on the city's files"));
    auto* layout = new QVBoxLayout(this);
    auto* bar = new QHBoxLayout;
    m_impl->words = new QLineEdit(this);
    m_impl->words->setObjectName(QStringLiteral("remarkFilter"));
    m_impl->words->setPlaceholderText(tr("Filter"));
    m_impl->words->setAccessibleName(tr("Filter the remarks"));
    m_impl->words->setClearButtonEnabled(true);
    m_impl->least = new QComboBox(this);
    m_impl->least->addItems({tr("All"), tr("Warnings and errors"), tr("Errors only")});
    m_impl->least->setAccessibleName(tr("Which remarks are shown"));
    m_impl->least->setToolTip(m_impl->least->accessibleName());
    m_impl->count = new QLabel(this);
    auto* copy = new QToolButton(this);
    copy->setObjectName(QStringLiteral("remarkCopy"));
    copy->setText(tr("Copy"));
    copy->setToolTip(tr("Copy the chosen remarks, or all that are shown, as a table (Ctrl+C)"));
    layout->addWidget(m_impl->words);
    bar->addWidget(m_impl->least);
    bar->addWidget(m_impl->count, 1);
    bar->addWidget(copy);
    layout->addLayout(bar);

    auto* table = new QTableView(this);
    m_impl->table = table;
    table->setModel(&m_impl->filter);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setSortingEnabled(true);
    table->sortByColumn(SeverityColumn, Qt::DescendingOrder);
    table->setAlternatingRowColors(true);
    table->setWordWrap(false);
    table->setTabKeyNavigation(false);
    table->verticalHeader()->hide();
    table->horizontalHeader()->setStretchLastSection(true);
    const int em = fontMetrics().averageCharWidth();
    table->setColumnWidth(SeverityColumn, 14 * em);
    table->setColumnWidth(ObjectColumn, 24 * em);
    table->setColumnWidth(TypeColumn, 14 * em);
    table->setColumnWidth(LodColumn, 8 * em);
    table->setColumnWidth(ResultColumn, 12 * em);
    table->setColumnWidth(CodeColumn, 20 * em);
    table->setColumnWidth(TextColumn, 50 * em);
    table->setColumnWidth(RemedyColumn, 40 * em);
    layout->addWidget(table, 1);
    // A panel at the window's edge is too narrow for the columns that matter most.
    m_impl->whole = new QLabel(this);
    m_impl->whole->setObjectName(QStringLiteral("remarkWhole"));
    m_impl->whole->setWordWrap(true);
    m_impl->whole->setTextFormat(Qt::PlainText);
    m_impl->whole->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(m_impl->whole);
    connect(table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) { m_impl->showWhole(index); });

    connect(m_impl->words, &QLineEdit::textChanged, this, [this] { m_impl->refilter(); });
    connect(m_impl->least, &QComboBox::currentIndexChanged, this, [this] { m_impl->refilter(); });
    connect(copy, &QToolButton::clicked, this, [this] { m_impl->copy(); });
    connect(new QShortcut(QKeySequence::Copy, table, nullptr, nullptr, Qt::WidgetShortcut),
            &QShortcut::activated, this, [this] { m_impl->copy(); });
    connect(table, &QTableView::activated, this,
            [this](const QModelIndex& index) { m_impl->activate(this, index); });
    m_impl->showCount();
}

RemarkList::~RemarkList() = default;

void RemarkList::setRemarks(std::vector<FileRemark> remarks) {
    m_impl->model.set(std::move(remarks));
    m_impl->whole->clear();
    m_impl->showCount();
}

int RemarkList::shownCount() const {
    return m_impl->filter.rowCount();
}

}  // namespace reflet
