// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/JobRunner.h"

#include <QEventLoop>
#include <QPointer>
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <utility>

namespace reflet {

namespace {
/// Progress is shown some 20 times a second: more cannot be read, and costs the interface time.
constexpr int kRefreshMilliseconds = 50;
/// Jobs use all cores from within; this many may wait for disks, encoders or locks at once.
constexpr int kMostThreads = 8;
}  // namespace

struct JobRunner::Job {
    quint64 id = 0;
    Options options;
    Work work;        ///< moved to the worker when the job starts
    Deliver deliver;  ///< stays on the GUI thread
    QPointer<QObject> owner;
    bool owned = false;
    bool started = false;  ///< handed to a thread, or cancelled before that
    std::stop_source stop;
    QMetaObject::Connection ownerGone;

    // Written by workers, read on the GUI thread.
    std::atomic<bool> running = false;
    std::mutex mutex;
    double fraction = 0.0;
    std::string phase;

    void report(double value, const std::string& name) {
        const std::lock_guard lock(mutex);
        fraction = value;
        phase = name;
    }
    JobStatus status() {
        const std::lock_guard lock(mutex);
        return {id,       options.title, QString::fromStdString(phase),
                fraction, !running,      stop.stop_requested()};
    }
};

JobRunner::JobRunner(QObject* parent) : QObject(parent) {
    m_threads.setMaxThreadCount(kMostThreads);
    m_refresh.setInterval(kRefreshMilliseconds);
    connect(&m_refresh, &QTimer::timeout, this, &JobRunner::refresh);
}

JobRunner::~JobRunner() {
    for (const auto& job : m_jobs) {
        job->stop.request_stop();
        disconnect(job->ownerGone);
    }
    m_threads.waitForDone();
}

quint64 JobRunner::start(Options options, Work work, Deliver deliver, QObject* owner) {
    if (options.replace && !options.lane.isEmpty())
        cancelLane(options.lane);
    auto job = std::make_shared<Job>();
    job->id = ++m_lastId;
    job->options = std::move(options);
    job->work = std::move(work);
    job->deliver = std::move(deliver);
    job->owner = owner;
    job->owned = owner != nullptr;
    if (owner != nullptr) {
        job->ownerGone =
            connect(owner, &QObject::destroyed, this, [this, id = job->id] { cancel(id); });
    }
    m_jobs.push_back(job);
    startWhatMay();
    if (!m_refresh.isActive())
        m_refresh.start();
    refresh();
    return job->id;
}

void JobRunner::startWhatMay() {
    for (auto job = m_jobs.begin(); job != m_jobs.end(); ++job) {
        const QString& lane = (*job)->options.lane;
        const bool waits =
            !lane.isEmpty() && std::any_of(m_jobs.begin(), job, [&](const auto& older) {
                return older->options.lane == lane;
            });
        if ((*job)->started || waits)
            continue;
        (*job)->started = true;
        m_threads.start([this, shared = *job, work = std::move((*job)->work)]() mutable {
            shared->running = true;
            const JobContext context(
                [shared](double fraction, const std::string& phase) {
                    shared->report(fraction, phase);
                },
                shared->stop.get_token());
            auto error = contained(work, context);
            work = nullptr;  // what it holds goes here, not on the GUI thread
            // The runner is alive: its destructor waits for this thread.
            QMetaObject::invokeMethod(
                this,
                [this, id = shared->id, error = std::move(error)]() mutable {
                    finish(id, std::move(error));
                },
                Qt::QueuedConnection);
        });
    }
}

std::optional<Error> JobRunner::contained(const Work& work, const JobContext& context) {
    if (context.cancelled())
        return JobContext::cancelledError();
    try {
        work(context);
        return std::nullopt;
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::ResourceLimit,
                     "the memory is used up",
                     "",
                     "Close other programs, or take a smaller part of the city.",
                     {}};
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Internal,
                     std::string("a fault inside Reflet: ") + exception.what(),
                     "",
                     "Please report it with what you did; your project is unchanged.",
                     {}};
    } catch (...) {
        return Error{ErrorCode::Internal,
                     "a fault inside Reflet",
                     "",
                     "Please report it with what you did; your project is unchanged.",
                     {}};
    }
}

void JobRunner::finish(quint64 id, std::optional<Error> error) {
    const auto found =
        std::find_if(m_jobs.begin(), m_jobs.end(), [id](const auto& job) { return job->id == id; });
    if (found == m_jobs.end())
        return;
    const auto job = *found;
    m_jobs.erase(found);
    disconnect(job->ownerGone);
    startWhatMay();
    const QPointer<JobRunner> self(this);
    if (job->stop.stop_requested())
        error = JobContext::cancelledError();
    {
        // The worker may hold the job a little longer: what `done` holds must go on this thread.
        const Deliver deliver = std::exchange(job->deliver, nullptr);
        if (!job->owned || job->owner)
            deliver(std::move(error));
        job->owner.clear();
    }
    if (!self)
        return;
    refresh();
    if (m_jobs.empty())
        Q_EMIT idle();
}

void JobRunner::cancel(quint64 id) {
    for (const auto& job : m_jobs) {
        if (job->id != id || !job->stop.request_stop())
            continue;
        if (job->started)
            continue;
        job->started = true;
        QMetaObject::invokeMethod(
            this, [this, id] { finish(id, JobContext::cancelledError()); }, Qt::QueuedConnection);
    }
    refresh();
}

void JobRunner::cancelLane(const QString& lane) {
    for (const auto& job : std::vector(m_jobs)) {
        if (job->options.lane == lane)
            cancel(job->id);
    }
}

void JobRunner::cancelAll() {
    for (const auto& job : std::vector(m_jobs))
        cancel(job->id);
}

bool JobRunner::wait(int milliseconds) {
    if (m_jobs.empty())
        return true;
    QEventLoop loop;
    connect(this, &JobRunner::idle, &loop, &QEventLoop::quit);
    QTimer::singleShot(milliseconds, &loop, &QEventLoop::quit);
    loop.exec();
    return m_jobs.empty();
}

std::vector<JobStatus> JobRunner::jobs() const {
    std::vector<JobStatus> out;
    for (const auto& job : m_jobs) {
        if (job->options.visible)
            out.push_back(job->status());
    }
    return out;
}

bool JobRunner::isBusy(const QString& lane) const {
    return std::any_of(m_jobs.begin(), m_jobs.end(),
                       [&](const auto& job) { return job->options.lane == lane; });
}

void JobRunner::refresh() {
    if (m_jobs.empty())
        m_refresh.stop();
    auto now = jobs();
    if (now == m_shown)
        return;
    m_shown = std::move(now);
    Q_EMIT jobsChanged();
}

}  // namespace reflet
