// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/frames/FrameSource.h"
#include "widgets/viewport/frames/SceneDrawer.h"

#include <QTimer>
#include <memory>

QT_BEGIN_NAMESPACE
class QOpenGLFramebufferObject;
QT_END_NAMESPACE

namespace reflet {

/// Draws when it is asked for the picture, in the widget's own context: for drivers that cannot
/// draw from several threads. Destroy it with that context current.
class InPlaceFrames : public FrameSource {
    Q_OBJECT
public:
    explicit InPlaceFrames(QObject* parent = nullptr);
    ~InPlaceFrames() override;

    void post(const SceneState& state) override;
    [[nodiscard]] std::optional<DrawnFrame> acquire() override;
    [[nodiscard]] std::uint64_t finished() const override { return m_number; }
    void loseContext() override;

private:
    void schedule();

    SceneState m_state;
    FrameDirector m_director;
    std::unique_ptr<SceneDrawer> m_drawer;
    std::unique_ptr<QOpenGLFramebufferObject> m_target;
    std::optional<DrawnFrame> m_frame;
    QTimer m_timer;
    std::uint64_t m_number = 0;
    bool m_failed = false;
};

}  // namespace reflet
