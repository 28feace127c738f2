// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace reflet {

class Viewport;

/// Waits for the first picture with a city in it and says once how long it took since the process
/// was started, shared libraries and all.
class FirstPicture : public QObject {
    Q_OBJECT
public:
    explicit FirstPicture(Viewport& viewport, QObject* parent = nullptr);

Q_SIGNALS:
    /// The picture is on the screen.
    void shown(int milliseconds);

private:
    bool m_seen = false;
};

/// Since this process was started, as the system tells; 0 where it does not tell.
[[nodiscard]] int millisecondsSinceStart();

}  // namespace reflet
