// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLWidget>
#include <functional>
#include <utility>

namespace reflet {

/// The place in a viewport that finished pictures are copied to where OpenGL shows them. It takes
/// no input: that goes to the viewport under it.
class GlCanvas : public QOpenGLWidget {
    Q_OBJECT
public:
    /// Both are called with its context current: when there is a new one, and for each picture.
    GlCanvas(std::function<void()> contextMade, std::function<void()> paint, QWidget* parent)
        : QOpenGLWidget(parent), m_contextMade(std::move(contextMade)), m_paint(std::move(paint)) {
        setObjectName(QStringLiteral("glCanvas"));
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setFocusPolicy(Qt::NoFocus);
    }

protected:
    void initializeGL() override { m_contextMade(); }
    void paintGL() override { m_paint(); }

private:
    std::function<void()> m_contextMade, m_paint;
};

}  // namespace reflet
