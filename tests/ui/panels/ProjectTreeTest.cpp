// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/Patience.h"
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/panels/ProjectTree.h"

#include <QAbstractItemModel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTreeView>
#include <vector>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;

class ProjectTreeTest : public testing::Test {
protected:
    void SetUp() override {
        tree.setProject(project);
        test::showWidget(tree, 300, 600);
        view = test::child<QTreeView>(tree, "treeView");
        QObject::connect(&tree, &ProjectTree::selectionChanged,
                         [this](const auto& items) { selections.push_back(items); });
        QObject::connect(&tree, &ProjectTree::removeRequested,
                         [this](const auto& items) { removals.push_back(items); });
        QObject::connect(&tree, &ProjectTree::frameRequested,
                         [this](const ProjectItem& item) { framed.push_back(item); });
        QObject::connect(&tree, &ProjectTree::renamed,
                         [this](const ProjectItem& item, const QString& name) {
                             names.emplace_back(item, name);
                         });
    }
    /// The row that shows this text.
    [[nodiscard]] QModelIndex row(const QString& text) const {
        const auto found = view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, text,
                                                1, Qt::MatchExactly | Qt::MatchRecursive);
        return found.empty() ? QModelIndex() : found.front();
    }
    void click(const QString& text, Qt::KeyboardModifiers keys = {}) {
        view->scrollTo(row(text));
        QTest::mouseClick(view->viewport(), Qt::LeftButton, keys,
                          view->visualRect(row(text)).center());
    }

    Project project = test::streetProject(12);
    ProjectTree tree;
    QTreeView* view = nullptr;
    std::vector<std::vector<ProjectItem>> selections, removals;
    std::vector<ProjectItem> framed;
    std::vector<std::pair<ProjectItem, QString>> names;
};

TEST_F(ProjectTreeTest, HeadingsCountWhatIsBelowThem) {
    EXPECT_TRUE(row(QStringLiteral("Reflection probes (12)")).isValid());
    EXPECT_TRUE(row(QStringLiteral("Routes (2)")).isValid());
    project.probes.pop_back();
    tree.setProject(project);
    EXPECT_TRUE(row(QStringLiteral("Reflection probes (11)")).isValid());
}

TEST_F(ProjectTreeTest, ClickingSelectsAndCtrlSelectsSeveral) {
    click(QStringLiteral("rem-2"));
    click(QStringLiteral("rem-4"), Qt::ControlModifier);
    ASSERT_EQ(selections.size(), 2U);
    EXPECT_EQ(selections[1],
              (std::vector<ProjectItem>{{Kind::Probe, "rem-2"}, {Kind::Probe, "rem-4"}}));
}

TEST_F(ProjectTreeTest, ASelectionFromOutsideIsShownButNotReported) {
    tree.setSelection({{Kind::Route, "route-1"}});
    EXPECT_TRUE(selections.empty());
    EXPECT_TRUE(view->selectionModel()->isSelected(row(QStringLiteral("Main street"))));
}

TEST_F(ProjectTreeTest, DeleteAndEnterAndDoubleClickSayWhatTheyMean) {
    click(QStringLiteral("rem-3"));
    QTest::keyClick(view, Qt::Key_Delete);
    ASSERT_EQ(removals.size(), 1U);
    EXPECT_EQ(removals[0], (std::vector<ProjectItem>{{Kind::Probe, "rem-3"}}));
    QTest::keyClick(view, Qt::Key_Return);
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {},
                       view->visualRect(row(QStringLiteral("rem-3"))).center());
    EXPECT_EQ(framed, (std::vector<ProjectItem>{{Kind::Probe, "rem-3"}, {Kind::Probe, "rem-3"}}));
}

TEST_F(ProjectTreeTest, F2AsksForANewNameAndChangesNothingItself) {
    click(QStringLiteral("rem-3"));
    QTest::keyClick(view, Qt::Key_F2);
    auto* editor = qobject_cast<QLineEdit*>(QApplication::focusWidget());
    ASSERT_NE(editor, nullptr);
    QTest::keyClick(editor, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(editor, QStringLiteral("station"));
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !names.empty(); }, test::kPatience));
    ASSERT_EQ(names.size(), 1U);
    EXPECT_EQ(names[0].first, (ProjectItem{Kind::Probe, "rem-3"}));
    EXPECT_EQ(names[0].second, QStringLiteral("station"));
    EXPECT_TRUE(row(QStringLiteral("rem-3")).isValid());
}

TEST_F(ProjectTreeTest, TheFilterShowsMatchesOnlyAndKeepsTheSelection) {
    click(QStringLiteral("rem-3"));
    selections.clear();
    auto* filter = test::child<QLineEdit>(tree, "treeFilter");
    QTest::keyClicks(filter, QStringLiteral("tram"));
    EXPECT_FALSE(row(QStringLiteral("rem-3")).isValid());
    EXPECT_TRUE(row(QStringLiteral("tram-1 (tram)")).isValid());
    EXPECT_TRUE(selections.empty());
    filter->clear();
    EXPECT_TRUE(view->selectionModel()->isSelected(row(QStringLiteral("rem-3"))));
}

TEST_F(ProjectTreeTest, ManyProbesChangeRowByRow) {
    project = test::streetProject(500);
    tree.setProject(project);
    tree.setSelection({{Kind::Probe, "rem-400"}});
    const QSignalSpy resets(view->model(), &QAbstractItemModel::modelReset);
    const QSignalSpy inserted(view->model(), &QAbstractItemModel::rowsInserted);
    const QSignalSpy removed(view->model(), &QAbstractItemModel::rowsRemoved);
    Project moved = project;
    moved.probes[250].position.x += 1.0;
    tree.setProject(moved);
    EXPECT_EQ(inserted.count() + removed.count() + resets.count(), 0) << "a move changes no row";
    moved.probes.erase(moved.probes.begin() + 10);
    tree.setProject(moved);
    EXPECT_EQ(removed.count(), 1);
    tree.setProject(project);
    EXPECT_EQ(inserted.count(), 1);
    EXPECT_EQ(resets.count(), 0);
    EXPECT_TRUE(view->selectionModel()->isSelected(row(QStringLiteral("rem-400"))));
    EXPECT_TRUE(selections.empty());
    EXPECT_EQ(view->model()->rowCount(row(QStringLiteral("Reflection probes (500)"))), 500);
}

TEST_F(ProjectTreeTest, ReorderedAndReplacedRowsEndUpAsInTheProject) {
    std::swap(project.probes[1], project.probes[8]);
    project.probes[4].id = "new";
    project.probes.erase(project.probes.begin());
    tree.setProject(project);
    const QModelIndex heading = row(QStringLiteral("Reflection probes (11)"));
    ASSERT_TRUE(heading.isValid());
    for (int i = 0; i < 11; ++i)
        EXPECT_EQ(view->model()->index(i, 0, heading).data().toString().toStdString(),
                  project.probes[std::size_t(i)].id);
}

TEST_F(ProjectTreeTest, AMissingModelIsMarked) {
    EXPECT_TRUE(row(QStringLiteral("street.city.json")).isValid());
    tree.setModelMarks({{"models/street.city.json", FileMark::Missing}});
    EXPECT_TRUE(row(QStringLiteral("street.city.json – missing")).isValid());
}

}  // namespace
}  // namespace reflet
