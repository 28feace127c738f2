// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/frames/HeadlessFrames.h"

#include "core/gpu/GlContext.h"
#include "core/gpu/ReadBackTarget.h"
#include "widgets/viewport/frames/FrameWorker.h"

#include <array>
#include <vector>

namespace reflet {

class HeadlessFrames::Worker : public FrameWorker {
public:
    using FrameWorker::FrameWorker;

protected:
    bool beginDrawing() override {
        Result<std::unique_ptr<GlContext>> context = GlContext::createHeadless();
        if (context) {
            m_context = std::move(*context);
        }
        return m_context != nullptr;
    }

    void endDrawing() override {
        m_target.reset();
        m_context.reset();
    }

    unsigned target(std::size_t /*place*/, int width, int height) override {
        if (!m_target || m_target->width() != width || m_target->height() != height) {
            m_target.reset();
            m_target = std::make_unique<ReadBackTarget>(width, height);
        }
        return m_target->framebuffer();
    }

    bool finish(std::size_t place, DrawnFrame& frame) override {
        const bool sound = m_target->read(m_pixels[place]);
        frame.pixels = m_pixels[place].data();
        return sound;
    }

private:
    std::unique_ptr<GlContext> m_context;
    std::unique_ptr<ReadBackTarget> m_target;
    std::array<std::vector<std::uint32_t>, FrameSlots::kCount> m_pixels;
};

HeadlessFrames::HeadlessFrames(QObject* parent)
    : FrameSource(parent), m_worker(std::make_unique<Worker>(*this)) {
    m_worker->setObjectName(QStringLiteral("reflet viewport"));
    m_worker->start();
}

HeadlessFrames::~HeadlessFrames() {
    m_worker->stop();
}

void HeadlessFrames::post(const SceneState& state) {
    m_worker->post(state);
}

std::optional<DrawnFrame> HeadlessFrames::acquire() {
    return m_worker->pictures().take(m_place);
}

std::uint64_t HeadlessFrames::finished() const {
    return m_worker->finished();
}

void HeadlessFrames::loseContext() {
    m_worker->loseContext();
}

}  // namespace reflet
