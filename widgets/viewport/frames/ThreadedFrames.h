// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/frames/FrameSource.h"

#include <memory>

QT_BEGIN_NAMESPACE
class QOpenGLContext;
QT_END_NAMESPACE

namespace reflet {

/// Draws on a thread of its own, into three textures in turn: one is drawn, one is finished, one is
/// shown. Made, used and destroyed on the interface's thread; destruction waits for the picture
/// that is being drawn.
class ThreadedFrames : public FrameSource {
    Q_OBJECT
public:
    /// shareWith: the widget's context, current.
    explicit ThreadedFrames(QOpenGLContext* shareWith, QObject* parent = nullptr);
    ~ThreadedFrames() override;

    void post(const SceneState& state) override;
    [[nodiscard]] std::optional<DrawnFrame> acquire() override;
    void released() override;
    [[nodiscard]] std::uint64_t finished() const override;
    void loseContext() override;

private:
    class Worker;
    std::unique_ptr<Worker> m_worker;
};

}  // namespace reflet
