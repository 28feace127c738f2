// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QToolBar>

namespace reflet {

/// A horizontal bar of buttons with a word under each, which gives up the words where it has not
/// the room for all of them, as in a small window at 200 %.
class ToolBar : public QToolBar {
    Q_OBJECT
public:
    explicit ToolBar(const QString& title, QWidget* parent = nullptr);

protected:
    void resizeEvent(QResizeEvent* event) override;
    bool event(QEvent* event) override;

private:
    void chooseStyle();
    /// Pixels that all buttons need with words.
    [[nodiscard]] int widthWithWords();

    int m_withWords = 0;  ///< 0: to be found out
};

}  // namespace reflet
