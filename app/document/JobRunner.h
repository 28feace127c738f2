// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"

#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

/// What a list of jobs shows of one.
struct JobStatus {
    quint64 id = 0;
    QString title;
    QString phase;  ///< what it is doing just now; may be empty
    double fraction = 0.0;
    bool waiting = false;  ///< for an older job of its lane, or for a free thread
    bool cancelling = false;

    friend bool operator==(const JobStatus&, const JobStatus&) = default;
};

/// Runs long work on threads of its own and brings the results to the GUI thread. All members are
/// called on the GUI thread; `work` runs elsewhere, on values that it owns, and polls its context
/// at least every 50 ms. Jobs of one lane never run at the same time.
class JobRunner : public QObject {
    Q_OBJECT
public:
    struct Options {
        QString title;
        QString lane = {};    ///< empty: the job waits for no other and replaces none
        bool replace = true;  ///< a new job of a lane cancels the older ones; else it queues behind
        bool visible = true;  ///< in jobs()
    };

    explicit JobRunner(QObject* parent = nullptr);
    /// Cancels everything and waits until all threads have returned. No `done` is called any more.
    ~JobRunner() override;

    /// Starts `work`. `done` is called once, on the GUI thread, never from inside a member of this
    /// class, and not at all once `owner` (unless null) is gone: its jobs are then cancelled. A job
    /// that was cancelled or replaced yields Cancelled even if it had finished meanwhile.
    /// Exceptions become Internal errors, ends of memory ResourceLimit.
    template <class T>
    quint64 run(Options options, std::function<Result<T>(const JobContext&)> work, QObject* owner,
                std::function<void(Result<T>)> done);

    void cancel(quint64 id);
    void cancelLane(const QString& lane);
    void cancelAll();
    /// Lets events pass until no job is left or the time is over; tells whether none is left. For
    /// tests, and for the end of the program after cancelAll().
    bool wait(int milliseconds);

    /// The visible jobs, oldest first; progress is brought up to date some 20 times a second.
    [[nodiscard]] std::vector<JobStatus> jobs() const;
    [[nodiscard]] bool isIdle() const { return m_jobs.empty(); }
    /// A job of that lane runs or waits.
    [[nodiscard]] bool isBusy(const QString& lane) const;

Q_SIGNALS:
    void jobsChanged();
    void idle();

private:
    /// Runs on a worker thread; what it returns runs on the GUI thread and delivers: the result, or
    /// the given error in its place.
    using Deliver = std::function<void(std::optional<Error>)>;
    using Work = std::function<void(const JobContext&)>;
    struct Job;

    quint64 start(Options options, Work work, Deliver deliver, QObject* owner);
    void startWhatMay();
    void finish(quint64 id, std::optional<Error> error);
    void refresh();

    /// Runs `work` with exceptions contained.
    static std::optional<Error> contained(const Work& work, const JobContext& context);

    std::vector<std::shared_ptr<Job>> m_jobs;
    std::vector<JobStatus> m_shown;
    QThreadPool m_threads;
    QTimer m_refresh;
    quint64 m_lastId = 0;
};

template <class T>
quint64 JobRunner::run(Options options, std::function<Result<T>(const JobContext&)> work,
                       QObject* owner, std::function<void(Result<T>)> done) {
    // Written by the worker, read on the GUI thread after the worker has said that it is done.
    const auto result = std::make_shared<std::optional<Result<T>>>();
    return start(
        std::move(options),
        [work = std::move(work), result](const JobContext& job) { result->emplace(work(job)); },
        [done = std::move(done), result](std::optional<Error> error) {
            if (!done)
                return;
            if (error) {
                done(tl::unexpected(std::move(*error)));
            } else {
                done(std::move(**result));
            }
        },
        owner);
}

}  // namespace reflet
