// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "core/reconstruction/Method.h"

#include <QObject>
#include <optional>
#include <string>

namespace reflet {

/// Which methods the picture shows on the two sides of its bar, and the check against the
/// reference: the vehicle is held, ray traced in the background, and the figures are shown.
class CompareController : public QObject {
    Q_OBJECT
public:
    CompareController(Workbench& bench, QObject* parent);

    void setMethods(Method left, std::optional<Method> right);
    [[nodiscard]] Method left() const { return m_left; }
    [[nodiscard]] std::optional<Method> right() const { return m_right; }
    /// Pauses the drive and measures the selected vehicle, or the first.
    void checkReference();

Q_SIGNALS:
    void checked();  ///< figures have come

private:
    void chooseMethods(Method left, std::optional<Method> right);
    void setCompared(bool compared);
    void swapSides();
    void measure();
    /// Turns the camera to the vehicle unless enough of it is seen.
    void bringIntoView(const std::string& reflector);
    void showFigures();
    void driveGoesOn();
    /// Back to what was shown before, when there is no reference to show.
    void withoutReference();
    [[nodiscard]] bool showsReference() const;
    [[nodiscard]] std::string measuredReflector() const;

    Workbench& m_bench;
    Method m_left = Method::Mem;
    std::optional<Method> m_right;
    /// What was shown before the reference was asked for.
    Method m_leftBefore = Method::Mem;
    std::optional<Method> m_rightBefore;
    bool m_asked = false;  ///< by the command, which answers with a message
};

}  // namespace reflet
