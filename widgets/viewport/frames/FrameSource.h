// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "widgets/viewport/frames/SceneState.h"

#include <QObject>
#include <optional>

namespace reflet {

/// Who draws the pictures of a viewport, in an OpenGL context that shares with the widget's.
class FrameSource : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    /// Hands over the newest state.
    virtual void post(const SceneState& state) = 0;
    /// The newest finished picture. To be called with the widget's context current; its texture is
    /// left alone until the next call. None before the first.
    [[nodiscard]] virtual std::optional<DrawnFrame> acquire() = 0;
    /// To be called when the commands that read the acquired picture have been issued.
    virtual void released() {}
    /// Number of the newest picture that is finished, acquired or not; 0 before the first.
    [[nodiscard]] virtual std::uint64_t finished() const = 0;
    /// Behaves as if the driver had lost the context (for tests).
    virtual void loseContext() = 0;

Q_SIGNALS:
    /// acquire() has something new. On the interface's thread.
    void frameReady();
    /// Nothing can be drawn, for good.
    void failed(const reflet::Error& error);
    /// The context is gone; a new source can go on.
    void contextLost();
};

}  // namespace reflet
