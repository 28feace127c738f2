// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/rehearsal/Hands.h"

#include <QApplication>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMimeData>
#include <QMouseEvent>
#include <QTimer>
#include <QUrl>
#include <QWidget>

namespace reflet::hands {

namespace {

constexpr int kLookMilliseconds = 5;  ///< between two looks at a condition

void send(QWidget& widget, QEvent::Type type, const QPoint& at, Qt::MouseButton button,
          Qt::MouseButtons held) {
    QMouseEvent event(type, at, widget.mapToGlobal(at), button, held, {});
    QApplication::sendEvent(&widget, &event);
}

}  // namespace

void press(QWidget& widget, const QPoint& at) {
    send(widget, QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton);
}

void move(QWidget& widget, const QPoint& to) {
    send(widget, QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
}

void release(QWidget& widget, const QPoint& at) {
    send(widget, QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton);
}

void click(QWidget& widget) {
    press(widget, widget.rect().center());
    release(widget, widget.rect().center());
}

void drop(QWidget& widget, const QStringList& files) {
    QMimeData data;
    QList<QUrl> urls;
    for (const QString& file : files) {
        urls << QUrl::fromLocalFile(file);
    }
    data.setUrls(urls);
    const QPoint middle = widget.rect().center();
    QDragEnterEvent enter(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&widget, &enter);
    QDropEvent drop(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&widget, &drop);
}

void ask(QWidget& widget, const std::function<void()>& what) {
    QMetaObject::invokeMethod(&widget, what, Qt::QueuedConnection);
}

void rest(int milliseconds) {
    waitFor([] { return false; }, milliseconds);
}

bool waitFor(const std::function<bool()>& condition, int milliseconds) {
    QElapsedTimer since;
    since.start();
    while (!condition()) {
        if (since.hasExpired(milliseconds)) {
            return false;
        }
        QEventLoop loop;
        QTimer::singleShot(kLookMilliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
        loop.exec();
    }
    return true;
}

}  // namespace reflet::hands
