// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>

class QVBoxLayout;

namespace reflet {

/// A sheet laid over a whole window that dims what is below: closed by Escape, by its button or by
/// a click beside it. It is no dialog: nothing waits for it, and it deletes itself when closed.
class Card : public QWidget {
    Q_OBJECT
public:
    Card(const QString& title, QWidget* window);
    /// Where the contents go, below the title.
    [[nodiscard]] QVBoxLayout* body() const { return m_body; }
    /// Covers the window and takes the keyboard.
    void open();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QFrame* m_sheet = nullptr;
    QVBoxLayout* m_body = nullptr;
};

}  // namespace reflet
