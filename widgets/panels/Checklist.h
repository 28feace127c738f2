// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>

class QLabel;
class QPushButton;

namespace reflet {

/// The first five minutes: what to do next, with a tick at what is done (DESIGN 8).
class Checklist : public QWidget {
    Q_OBJECT

public:
    enum Step { OpenCity, DrawRoute, MakeItReflect, CheckAgainstReference, SaveSomething };
    static constexpr int kSteps = 5;

    explicit Checklist(QWidget* parent = nullptr);

    void setDone(Step step, bool done);
    [[nodiscard]] bool done(Step step) const { return m_done[std::size_t(step)]; }
    /// A step that cannot be taken yet is shown, but not clickable.
    void setPossible(Step step, bool possible);

Q_SIGNALS:
    void stepActivated(int step);
    void left();  ///< the user closed the list

protected:
    void changeEvent(QEvent* event) override;

private:
    void refresh();

    std::array<bool, kSteps> m_done{};
    std::array<bool, kSteps> m_possible{true, true, true, true, true};
    std::array<QPushButton*, kSteps> m_buttons{};
    std::array<QLabel*, kSteps> m_help{};
    QLabel* m_title = nullptr;
};

}  // namespace reflet
