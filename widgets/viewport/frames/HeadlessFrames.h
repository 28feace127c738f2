// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/viewport/frames/FrameSource.h"

#include <memory>

namespace reflet {

/// Draws on a thread of its own in a context that has nothing to do with the window's, and hands
/// pixels over. For drivers that draw in software: Mesa's works off what all contexts of one
/// display want in turn, so that a window that shares with a busy thread waits for its pictures;
/// contexts of two displays do not wait for each other, and copying pixels costs next to nothing
/// there.
class HeadlessFrames : public FrameSource {
    Q_OBJECT
public:
    explicit HeadlessFrames(QObject* parent = nullptr);
    ~HeadlessFrames() override;

    void post(const SceneState& state) override;
    [[nodiscard]] std::optional<DrawnFrame> acquire() override;
    [[nodiscard]] std::uint64_t finished() const override;
    void loseContext() override;

private:
    class Worker;
    std::unique_ptr<Worker> m_worker;
    std::size_t m_place = 0;
};

}  // namespace reflet
